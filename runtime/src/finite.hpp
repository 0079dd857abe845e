// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "plumb/runtime/transform.hpp"

/// What the cycle accepts as input. Never traps, whatever the bits are.
namespace plumb::internal {

/// Joint positions beyond this are no arm's, [rad] or [m]; below it sin_cos is exact.
inline constexpr double kMaxJointPosition = 1e4;

/// Allowed departure of R^T R from the identity: what quaternions in single precision leave.
inline constexpr double kMaxShear = 1e-6;

bool is_finite(double x) noexcept;
bool is_finite(const Vector3& v) noexcept;

/// Finite and within kMaxJointPosition.
bool is_joint_state(std::span<const double> q) noexcept;

/// A finite translation and a proper rotation (determinant +1).
bool is_pose(const Transformd& X) noexcept;

}  // namespace plumb::internal
