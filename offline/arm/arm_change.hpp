// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// `start` after a change of each parameter, shape (parameters,). DH values, link twists and
/// positions of targets add. Rotations of frames and targets are multiplied by exp of their change
/// from the right; frames shift in base coordinates.
ArmState moved(const ArmState& start, const std::vector<Parameter>& parameters,
               const Eigen::VectorXd& change);

/// Value of the parameter. Rotations of frames and targets are given as components of their
/// rotation vectors [rad].
double value_of(const ArmState& state, const Parameter& parameter);

/// The three components from `first_component` on of one kind and set-up out of a change: a shift
/// or a turn of its frame or target.
Vector3 gathered(const std::vector<Parameter>& parameters, const Eigen::VectorXd& change,
                 Parameter::Kind kind, int first_component, int setup = 0);

/// A start for a fit. In a formula like k (1 + c tau2), k = 0 makes the derivative by c vanish;
/// parameters that are 0 in such a non-linear formula are set to their typical size.
ArmState unhidden(ArmState state);

/// The rotation of a rotation vector [rad].
Transformd turned(const Vector3& e);

}  // namespace plumb::offline
