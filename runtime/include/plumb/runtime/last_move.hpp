// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/runtime/context.hpp"

namespace plumb {

/// Direction and size of each joint's last move, from joint positions cycle by cycle.
///
/// A joint moves on while it passes the farthest point it reached; it has turned when it came back
/// from there by more than the dead band. At rest both values are held. Before the first move
/// beyond the dead band both are unknown. The size is the way since the joint last turned.
///
///     q   turn ----------------> far        direction +1, travel far - turn
///                        q <---- far        turned once far - q > dead band
///
/// The dead band must be wider than the noise of the positions and, where these are measured, than
/// what the effects of direction themselves move a joint; else the two would chase each other.
/// Heap: none. Thread: one. Cost: fixed. Errors: none; positions that are not finite are skipped.
class LastMove {
 public:
  using Joints = std::array<double, format::kMaxJoints>;

  /// dead_band: one per joint, [rad] or [m].
  explicit LastMove(const Joints& dead_band) noexcept : dead_band_(dead_band) {}

  /// The positions now, shape (n,), [rad] or [m]. They come from one source, cycle after cycle.
  void follow(std::span<const double> q) noexcept;

  /// The next positions come from another source: what lies between the two is no move.
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
