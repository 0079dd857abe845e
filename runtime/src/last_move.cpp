// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/last_move.hpp"

#include <algorithm>

#include "finite.hpp"

namespace plumb {
namespace {

bool known(double direction) noexcept { return direction == direction; }

}  // namespace

double LastMove::travel(std::size_t joint) const noexcept {
  const Joint& at = joints_[joint];
  return known(at.direction) ? at.direction * (at.far - at.turn) : kUnknown;
}

void LastMove::move(Joint& joint, double q, double dead_band) noexcept {
  const double way = q - joint.far;
  const bool beyond = way > dead_band || -way > dead_band;
  const double heading = way > 0.0 ? 1.0 : -1.0;
  if (known(joint.direction) && joint.direction * way > 0.0) {
    joint.far = q;
  } else if (beyond) {
    joint = {.turn = joint.far, .far = q, .direction = heading};
  }
}

void LastMove::rebase(Joint& joint, double q) noexcept {
  const double way = known(joint.direction) ? joint.far - joint.turn : 0.0;
  joint.far = q;
  joint.turn = q - way;
}

void LastMove::follow(std::span<const double> q) noexcept {
  if (!internal::is_joint_state(q)) return;
  const std::size_t n = std::min(q.size(), joints_.size());
  for (std::size_t i = 0; i < n; ++i)
    rebase_ ? rebase(joints_[i], q[i]) : move(joints_[i], q[i], dead_band_[i]);
  rebase_ = false;
}

}  // namespace plumb
