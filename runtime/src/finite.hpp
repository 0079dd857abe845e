// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "plumb/runtime/transform.hpp"

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

/// Finite and within kMaxJointPosition.
inline bool is_joint_state(std::span<const double> q) noexcept {
  std::uint64_t largest = 0;
  for (const double x : q) {
    const std::uint64_t key = magnitude_key(x);
    largest = key > largest ? key : largest;
  }
  return largest <= magnitude_key(kMaxJointPosition);
}

/// A finite translation and a proper rotation (determinant +1).
bool is_pose(const Transformd& X) noexcept;

}  // namespace plumb::internal
