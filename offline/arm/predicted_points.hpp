// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/measurements.hpp"
#include "plumb/runtime/forward_model.hpp"

namespace plumb::offline {

/// Predicted points in the measurement frame [m], shape (n, 3), computed by the code of the
/// runtime. If `at` has departures of the controller's own positions, these are added.
Rows3 predict_points(const ArmState& state, const Measurements& at);

/// Where the target is in the frame of its set-up [m], whatever the row reads of it.
Rows3 predict_targets(const ArmState& state, const Measurements& at);

/// The same if only joint positions are known, with frame and target of the first set-up.
Rows3 predict_points(const ArmState& state, const RowsN& q);

/// The context of row `row`. The tracker stands at the origin of the measurement frame.
MeasuredContext context_of(const Measurements& at, Eigen::Index row,
                           const std::vector<std::string>& sensors, const Transformd& X_MB);

/// The turn from the predicted to the measured orientation of the target, as a rotation vector in
/// the target's frame [rad], shape (n, 3).
Rows3 turns_of_target(const ArmState& state, const Measurements& measured);

/// Angle between measured and predicted orientation of the reflector [rad], shape (n,).
Eigen::VectorXd turn_errors(const ArmState& state, const Measurements& measured);

/// measured - predicted [m]; missing axes are 0.
Rows3 residuals(const Measurements& measured, const Rows3& predicted);

/// Where the target was in each row, in the base frame [m], shape (n, 3): where it was measured,
/// and in rows about planes and distances, which do not say it, where `state` has it.
Rows3 places_B(const ArmState& state, const Measurements& at);

/// Rotates residuals from the measurement frame to the base frame; row i is of the set-up of row i
/// of `at`. That of a distance points away from its centre.
Rows3 to_base(const ArmState& state, const Measurements& at, const Rows3& v_M);

}  // namespace plumb::offline
