// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lanes.hpp"

/// What the cycle accepts as input. Never traps, whatever the bits are.
namespace plumb::internal {

/// Joint positions beyond this are no arm's, [rad] or [m]; below it sin_cos is exact.
inline constexpr double kMaxJointPosition = 1e4;

/// Allowed departure of R^T R from the identity: what quaternions in single precision leave.
inline constexpr double kMaxShear = 1e-6;

/// Grows with the magnitude of a number; infinity and NaN are above all others.
inline std::uint64_t magnitude_key(double x) noexcept {
  return std::bit_cast<std::uint64_t>(x) << 1;
}

inline bool is_finite(double x) noexcept { return x - x == 0.0; }

inline bool is_finite(const Vector3& v) noexcept {
  return is_finite((v(0) - v(0)) + (v(1) - v(1)) + (v(2) - v(2)));
}

/// Of the first three.
inline bool is_finite(const Lanes& v) noexcept {
  const Lanes none = v - v;
  return none[0] + none[1] + none[2] == 0.0;
}

/// kCount: known when compiled, so that the loop is unrolled; 0: any number.
template <std::size_t kCount>
bool all_within(std::span<const double> q) noexcept {
  const std::size_t n = kCount > 0 ? kCount : q.size();
  PackedBits near = ~PackedBits{};
  for (std::size_t i = 0; i < n; i += kPackedLanes)
    near &= within(load_some(q.data() + i, n - i), kMaxJointPosition);
  return all(near);
}

/// Finite and within kMaxJointPosition.
inline bool is_joint_state(std::span<const double> q) noexcept {
  return q.size() == 6 ? all_within<6>(q) : all_within<0>(q);
}

/// A finite translation and a proper rotation (determinant +1).
///
/// By rows, so that three sums are made at once. The fourth column is 0, or NaN beside what is not
/// finite. Of unit rows at right angles the cross product of two is the third, or, at determinant
/// -1, its opposite, which is away from it by more than 1 in some place.
inline bool is_pose(const Transformd& X) noexcept {
  const Lanes p = origin(X);
  const auto [a, b, c] = rows(axis(X, 0), axis(X, 1), axis(X, 2), p - p);
  const Lanes lengths = a * a + b * b + c * c - Lanes{1.0, 1.0, 1.0, 0.0};
  const Lanes angles = a * turned(a) + b * turned(b) + c * turned(c);
  const Lanes mirrored = cross(b, c) - a;
  return all(within(lengths, kMaxShear) & within(angles, kMaxShear) & within(mirrored, 1.0));
}

}  // namespace plumb::internal
