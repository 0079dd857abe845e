// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// Change of each parameter from its start, shape (parameters,). DH values add; twists and frames
/// act by Exp; X_MB turns by Exp and shifts in base coordinates.
ArmState moved(const ArmState& start, const std::vector<Parameter>& parameters,
               const Eigen::VectorXd& change);

double value_of(const ArmState& state, const Parameter& parameter);

/// Three components of one kind out of a change: a shift or turn of frame or target of a set-up.
Vector3 gathered(const std::vector<Parameter>& parameters, const Eigen::VectorXd& change,
                 Parameter::Kind kind, int first_component, int setup = 0);

/// Where a search may begin: of a formula in which a parameter that is 0 hides another one, as k in
/// k (1 + c tau2), the hiding ones are of typical size.
ArmState unhidden(ArmState state);

/// Turned by a rotation vector [rad].
Transformd turned(const Vector3& e);

}  // namespace plumb::offline
