// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "cell/measurements.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// Which lines of a least-squares problem one reading of a tracker gives, and how a motion of the
/// reflector stands in them: first the measured axes of its point [m], then, if its orientation
/// was measured and is used, its rotation about three axes [rad]. All in the measurement frame.
class TrackerReading {
 public:
  TrackerReading() = default;
  TrackerReading(const Measurements& measured, bool with_orientation)
      : has_axis_(measured.has_axis), turns_(with_orientation) {
    for (const bool has : has_axis_) points_ += has ? 1 : 0;
  }

  /// Lines of the point, of the rotation, and of both.
  int point_lines() const { return points_; }
  int turn_lines() const { return turns_ ? 3 : 0; }
  int lines() const { return point_lines() + turn_lines(); }

  /// Calls visit(k) for each line in order: component k of (shift, turn), 0 to 5.
  template <class Visit>
  void components(const Visit& visit) const {
    for (int k = 0; k < 3; ++k)
      if (has_axis_[static_cast<std::size_t>(k)]) visit(k);
    for (int k = 0; k < turn_lines(); ++k) visit(3 + k);
  }

  /// The lines of a motion of the reflector: its point shifts [m] and it turns by a small rotation
  /// vector [rad]. lines(i) is written for i below lines().
  template <class Lines>
  void project(const Vector3& shift_M, const Vector3& turn_M, Lines&& lines) const {
    Eigen::Index line = 0;
    components([&](int k) { lines(line++) = k < 3 ? shift_M(k) : turn_M(k - 3); });
  }

 private:
  std::array<bool, 3> has_axis_{};
  int points_ = 0;
  bool turns_ = false;
};

}  // namespace plumb::offline
