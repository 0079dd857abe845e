// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "normal_equations.hpp"

namespace plumb::internal {

/// What fewer than six joints can influence, as generic ranks of the nominal Jacobian:
/// a planar arm with two joints has position 2 and pose 2, a SCARA position 3 and pose 4.
struct Controllable {
  int position = 3;
  int pose = 6;
};

/// Step of an arm with fewer than six joints: the position first, as well as it can be met, then
/// the orientation with what freedom the position leaves; each least squares, shortest step.
///
///   dq = Jp^+ rp + (Jo Z)^+ (ro - Jo Jp^+ rp),   Z projecting on the null space of Jp
///
/// A direction beyond the generic ranks is ignored. Cost: fixed for given ranks.
JointVector priority_step(const Jacobian& J, const Controllable& can, const Vector6& r) noexcept;

}  // namespace plumb::internal
