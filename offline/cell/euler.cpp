// SPDX-License-Identifier: Apache-2.0
#include "cell/euler.hpp"

#include <Eigen/Geometry>

namespace plumb::offline {
namespace {

constexpr std::string_view kVector = "rotation-vector";

Eigen::Quaterniond turn_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

}  // namespace

std::optional<EulerConvention> find_euler_convention(std::string_view name) {
  EulerConvention out;
  out.is_vector = name == kVector;
  if (out.is_vector) return out;
  if (name.find('-') != 3 || (name.substr(4) != "fixed" && name.substr(4) != "moving"))
    return std::nullopt;
  for (int i = 0; i < 3; ++i) {
    out.axes[i] = name[i] - 'x';
    if (out.axes[i] < 0 || out.axes[i] > 2 || (i > 0 && out.axes[i] == out.axes[i - 1]))
      return std::nullopt;
  }
  out.moving = name.substr(4) == "moving";
  return out;
}

std::string name_of(const EulerConvention& convention) {
  if (convention.is_vector) return std::string(kVector);
  std::string out;
  for (const int axis : convention.axes) out += "xyz"[axis];
  return out + (convention.moving ? "-moving" : "-fixed");
}

std::array<double, 4> quaternion(const EulerConvention& convention,
                                 const std::array<double, 3>& turns) {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  if (convention.is_vector) q = turn_of({turns[0], turns[1], turns[2]});
  for (int i = 0; i < 3 && !convention.is_vector; ++i) {
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(turns[i], Eigen::Vector3d::Unit(convention.axes[i])));
    q = convention.moving ? q * turn : turn * q;
  }
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  return {sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()};
}

}  // namespace plumb::offline
