// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace plumb::offline {

/// Unit quaternion (w, x, y, z) of R = Rz(rpy[2]) Ry(rpy[1]) Rx(rpy[0]), w >= 0; [rad].
std::array<double, 4> quaternion_from_rpy(const std::array<double, 3>& rpy);

/// Roll, pitch, yaw [rad] of a unit quaternion; at pitch = ±90° any of the many is given.
std::array<double, 3> rpy_from_quaternion(const std::array<double, 4>& q);

}  // namespace plumb::offline
