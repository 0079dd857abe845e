// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
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

/// Magnitudes are compared as integers, by the sign of what is left of the largest.
/// kCount: known when compiled, so that the loop is unrolled; 0: any number.
template <std::size_t kCount>
bool all_within(std::span<const double> q) noexcept {
  const std::size_t n = kCount > 0 ? kCount : q.size();
  constexpr auto kLargest = std::bit_cast<std::int64_t>(kMaxJointPosition);
  PackedBits left{};
  for (std::size_t i = 0; i < n; i += kPackedLanes) {
    const auto bits = reinterpret_cast<PackedBits>(load_some(q.data() + i, n - i));
    left |= kLargest - (bits & std::numeric_limits<std::int64_t>::max());
  }
  return !any_sign(left);
}

/// Finite and within kMaxJointPosition.
inline bool is_joint_state(std::span<const double> q) noexcept {
  return q.size() == 6 ? all_within<6>(q) : all_within<0>(q);
}

/// A finite translation and a proper rotation (determinant +1).
bool is_pose(const Transformd& X) noexcept;

}  // namespace plumb::internal
