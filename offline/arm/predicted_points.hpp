// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/measurements.hpp"
#include "plumb/runtime/forward_model.hpp"

namespace plumb::offline {

/// Predicted point in the measurement frame [m], shape (n, 3), through the runtime's own code; from
/// the controller's own positions where `at` has their departures.
Rows3 predict_points(const ArmState& state, const Measurements& at);

/// The same by the arm alone, where nothing but the joint positions is known; first set-up.
Rows3 predict_points(const ArmState& state, const RowsN& q);

/// What is known of row `row`; the tracker stands at the origin of the measurement frame.
MeasuredContext context_of(const Measurements& at, Eigen::Index row,
                           const std::vector<std::string>& sensors, const Transformd& X_MB);

/// Angle between measured and predicted orientation of the reflector [rad], shape (n,).
Eigen::VectorXd turn_errors(const ArmState& state, const Measurements& measured);

/// measured - predicted [m]; missing axes are 0.
Rows3 residuals(const Measurements& measured, const Rows3& predicted);

/// Rotates measurement-frame vectors into the base frame, row by row of `at`.
Rows3 to_base(const ArmState& state, const Measurements& at, const Rows3& v_M);

}  // namespace plumb::offline
