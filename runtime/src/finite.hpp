// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "lane_choices.hpp"
#include "lane_order.hpp"
#include "lanes.hpp"
#include "pose_lanes.hpp"
#include "six_joints.hpp"

/// The checks of the cycle's inputs. They never trap, whatever the bits of the input are.
namespace plumb::internal {

/// No arm has joint positions beyond this, [rad] or [m]; below it sin_cos is accurate.
inline constexpr double kMaxJointPosition = 1e4;

/// Largest accepted element of R^T R - I: quaternions in single precision deviate as much.
inline constexpr double kMaxShear = 1e-6;

/// An integer that grows with the magnitude of x; infinity and NaN give the largest ones.
inline std::uint64_t magnitude_key(double x) noexcept {
  return std::bit_cast<std::uint64_t>(x) << 1;
}

inline bool is_finite(double x) noexcept { return x - x == 0.0; }

inline bool is_finite(const Vector3& v) noexcept {
  return is_finite((v(0) - v(0)) + (v(1) - v(1)) + (v(2) - v(2)));
}

/// True if the magnitudes of the first three lanes are at most `limit`; false for NaN.
inline bool three_within(const Lanes& v, double limit) noexcept {
#ifdef __AVX__
  return (__builtin_ia32_movmskpd256(reinterpret_cast<Packed>(within(v, limit))) & 7) == 7;
#else
  return all(within(Lanes{v[0], v[1], v[2], v[2]}, limit));
#endif
}

/// True if the first three lanes are finite.
inline bool is_finite(const Lanes& v) noexcept {
  return three_within(v, std::numeric_limits<double>::max());
}

/// True if all positions are finite and their magnitudes at most kMaxJointPosition.
inline bool is_joint_state(const SixJoints& q) noexcept {
  PackedBits near = ~PackedBits{};
  for (const Packed& part : q.at) near &= within(part, kMaxJointPosition);
  return all(near);
}

inline bool is_joint_state(std::span<const double> q) noexcept {
  if (q.size() == 6) return is_joint_state(SixJoints(q.data()));
  PackedBits near = ~PackedBits{};
  for (std::size_t i = 0; i < q.size(); i += kPackedLanes)
    near &= within(load_some(q.data() + i, q.size() - i), kMaxJointPosition);
  return all(near);
}

/// True if the translation is finite and the matrix is a rotation (determinant +1).
///
/// The check works on rows, so that three sums are computed at once. The fourth column is 0 for a
/// finite translation and NaN otherwise. The cross product of two orthonormal rows is the third row
/// or, if the determinant is -1, its opposite, which differs from it by more than 1 in some
/// element.
inline bool is_pose(const Transformd& X) noexcept {
  const Lanes p = origin(X);
  const auto [a, b, c] = rows(axis(X, 0), axis(X, 1), axis(X, 2), p - p);
  const Lanes lengths = a * a + b * b + c * c - Lanes{1.0, 1.0, 1.0, 0.0};
  const Lanes angles = a * turned(a) + b * turned(b) + c * turned(c);
  const Lanes mirrored = cross(b, c) - a;
  return all(within(lengths, kMaxShear) & within(angles, kMaxShear) & within(mirrored, 1.0));
}

}  // namespace plumb::internal
