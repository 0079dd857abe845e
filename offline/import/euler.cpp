// SPDX-License-Identifier: Apache-2.0
#include "import/euler.hpp"

#include <Eigen/Geometry>

#include "program/problem.hpp"

namespace plumb::offline {

EulerConvention euler_convention(std::string_view name) {
  EulerConvention out;
  const auto dash = name.find('-');
  bool good = dash == 3 && (name.substr(4) == "fixed" || name.substr(4) == "moving");
  for (int i = 0; good && i < 3; ++i) {
    out.axes[i] = name[i] - 'x';
    good = out.axes[i] >= 0 && out.axes[i] <= 2 && (i == 0 || out.axes[i] != out.axes[i - 1]);
  }
  if (!good)
    throw Failure(Exit::kUsage,
                  {.code = "E-IMPORT-ROT",
                   .message = "--rot: '" + std::string(name) + "' is no order of turns",
                   .help = "xyz-fixed (R = Rz Ry Rx), xyz-moving (R = Rx Ry Rz), zyz-moving, ..."});
  out.moving = name.substr(4) == "moving";
  return out;
}

std::array<double, 4> quaternion(const EulerConvention& convention,
                                 const std::array<double, 3>& turns) {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(turns[i], Eigen::Vector3d::Unit(convention.axes[i])));
    q = convention.moving ? q * turn : turn * q;
  }
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  return {sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()};
}

}  // namespace plumb::offline
