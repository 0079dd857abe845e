// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "normal_equations.hpp"

namespace plumb::internal {

/// What an arm with fewer than six joints can influence, as generic ranks of the nominal Jacobian:
/// a planar arm with two joints has position 2 and pose 2, a SCARA arm position 3 and pose 4.
struct Controllable {
  int position = 3;
  int pose = 6;
};

/// Step of an arm with fewer than six joints: first the position in the least-squares sense, then
/// the orientation with the freedom that the position leaves. Both are the shortest steps.
///
///   dq = Jp^+ rp + (Jo Z)^+ (ro - Jo Jp^+ rp),   Z projecting on the null space of Jp
///
/// A direction beyond the generic ranks is ignored. Cost: fixed for given ranks.
JointVector priority_step(const Jacobian& J, const Controllable& can, const Vector6& r) noexcept;

}  // namespace plumb::internal
