// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/runtime/context.hpp"

namespace plumb {

/// Direction and size of each joint's last move, found from its positions cycle by cycle.
///
/// A joint continues its move whenever it passes the farthest point that it has reached. It has
/// turned round when it is back from there by more than the dead band. The size of the move is the
/// distance between the last turn and the farthest point. At rest direction and size are held;
/// before the first move beyond the dead band both are unknown.
///
///     q   turn ----------------> far        direction +1, travel far - turn
///                        q <---- far        turned once far - q > dead band
///
/// The dead band must be wider than the noise of the positions. For measured positions it must also
/// be wider than the motion that direction-dependent effects cause; otherwise the correction could
/// reverse the direction, and the direction the correction.
/// Heap: none. Thread: one. Cost: fixed. Errors: none; positions that are not finite are skipped.
class LastMove {
 public:
  using Joints = std::array<double, format::kMaxJoints>;

  /// dead_band: one per joint, [rad] or [m].
  explicit LastMove(const Joints& dead_band) noexcept : dead_band_(dead_band) {}

  /// Takes the present positions, shape (n,), [rad] or [m]. They must come from the same source in
  /// every cycle, unless change_source() was called before.
  void follow(std::span<const double> q) noexcept;

  /// The next positions come from another source, so their difference from the last is no move.
  void change_source() noexcept { rebase_ = true; }

  double direction(std::size_t joint) const noexcept { return joints_[joint].direction; }
  double travel(std::size_t joint) const noexcept;

 private:
  struct Joint {
    double turn = 0.0;
    double far = 0.0;
    double direction = kUnknown;
  };
  void move(Joint& joint, double q, double dead_band) noexcept;
  void rebase(Joint& joint, double q) noexcept;

  Joints dead_band_;
  std::array<Joint, format::kMaxJoints> joints_;
  bool rebase_ = true;
};

}  // namespace plumb
