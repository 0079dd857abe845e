// SPDX-License-Identifier: Apache-2.0
#include "cell/rotation.hpp"

#include <cmath>

namespace plumb::offline {

std::array<double, 4> quaternion_from_rpy(const std::array<double, 3>& rpy) {
  const double cr = std::cos(rpy[0] / 2), sr = std::sin(rpy[0] / 2);
  const double cp = std::cos(rpy[1] / 2), sp = std::sin(rpy[1] / 2);
  const double cy = std::cos(rpy[2] / 2), sy = std::sin(rpy[2] / 2);
  std::array<double, 4> q{cy * cp * cr + sy * sp * sr, cy * cp * sr - sy * sp * cr,
                          cy * sp * cr + sy * cp * sr, sy * cp * cr - cy * sp * sr};
  const double norm =
      std::copysign(std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), q[0]);
  for (double& x : q) x = x / norm + 0.0;
  return q;
}

// The roll is taken from Rz(-yaw) R, so that the product stays right where pitch is near ±90° and
// roll and yaw alone are not determined.
std::array<double, 3> rpy_from_quaternion(const std::array<double, 4>& q) {
  const auto [w, x, y, z] = q;
  const double r00 = w * w + x * x - y * y - z * z, r10 = 2 * (x * y + w * z);
  const double r20 = 2 * (x * z - w * y);
  const double r01 = 2 * (x * y - w * z), r11 = w * w - x * x + y * y - z * z;
  const double r02 = 2 * (x * z + w * y), r12 = 2 * (y * z - w * x);
  const double yaw = std::atan2(r10, r00);
  const double c = std::cos(yaw), s = std::sin(yaw);
  const double pitch = std::atan2(-r20, c * r00 + s * r10);
  const double roll = std::atan2(s * r02 - c * r12, c * r11 - s * r01);
  return {roll, pitch, yaw};
}

}  // namespace plumb::offline
