// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "cell/measurements.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// What a reading says where the target is at p_M, in the frame of its artefact or instrument:
/// p_M itself, or how far it is from the origin, less a length.
inline Vector3 read_at(ReadingKind kind, const Vector3& p_M, double length_m) {
  return descriptor_of(kind).radial ? Vector3(p_M.norm() - length_m, 0.0, 0.0) : p_M;
}

/// Which lines of a least-squares problem one row gives, and how a motion of the target stands in
/// them: first the coordinates that it reads [m], then, if its orientation was measured and is
/// used, its rotation about three axes [rad]. All in the frame of its instrument or artefact.
class Reading {
 public:
  Reading() = default;
  Reading(const Measurements& measured, Eigen::Index row, bool with_orientation)
      : radial_(descriptor_of(measured.kind_of(row)).radial),
        turns_(with_orientation && !measured.of_artefact(row)) {
    for (int k = 0; k < 3; ++k) reads_[static_cast<std::size_t>(k)] = measured.reads(row, k);
    points_ = measured.axes(row);
  }

  /// Lines of the point, of the rotation, and of both.
  int point_lines() const { return points_; }
  int turn_lines() const { return turns_ ? 3 : 0; }
  int lines() const { return point_lines() + turn_lines(); }

  /// Calls visit(k) for each line in order: component k of (shift, turn), 0 to 5. The component of
  /// a distance is 0.
  template <class Visit>
  void components(const Visit& visit) const {
    for (int k = 0; k < 3; ++k)
      if (reads_[static_cast<std::size_t>(k)]) visit(k);
    for (int k = 0; k < turn_lines(); ++k) visit(3 + k);
  }

  /// The lines of a motion of the target: it shifts [m] and turns by a small rotation vector [rad].
  /// p_M: where it is. lines(i) is written for i below lines().
  template <class Lines>
  void project(const Vector3& p_M, const Vector3& shift_M, const Vector3& turn_M,
               Lines&& lines) const {
    const double along = radial_ ? p_M.normalized().dot(shift_M) : 0.0;
    Eigen::Index line = 0;
    components([&](int k) {
      lines(line++) = k >= 3 ? turn_M(k - 3) : radial_ ? along : shift_M(k);
    });
  }

 private:
  std::array<bool, 3> reads_{};
  int points_ = 0;
  bool radial_ = false, turns_ = false;
};

}  // namespace plumb::offline
