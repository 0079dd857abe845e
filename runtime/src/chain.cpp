// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/chain.hpp"

#include <algorithm>

namespace plumb {
namespace {

Transformd link(const format::JointRow& row) noexcept {
  return translation(row.a, 0.0, 0.0) * rot_x(row.alpha) * rot_y(row.beta);
}

/// What is constant in a row ahead of the joint's motion.
Transformd ahead(const format::JointRow& row, format::Convention convention) noexcept {
  Transformd X = exp(row.pre);
  if (convention == format::Convention::kModified) X = link(row) * X;
  if (row.type == format::JointType::kPrismatic) X = X * rot_z(row.theta);
  return X;
}

/// What is constant in a row behind the joint's motion.
Transformd behind(const format::JointRow& row, format::Convention convention) noexcept {
  Transformd X = exp(row.post);
  if (row.type == format::JointType::kRevolute) X = translation(0.0, 0.0, row.d) * X;
  if (convention == format::Convention::kStandard) X = X * link(row);
  return X;
}

}  // namespace

Chain::Chain(const format::Chain& parameters) noexcept
    : joints_(std::min(static_cast<int>(parameters.joints.size()), kMaxJoints)) {
  constant_[0] = from_pose(parameters.base) * exp(parameters.base_twist);
  for (int i = 0; i < joints_; ++i) {
    const auto& row = parameters.joints[i];
    revolute_[i] = row.type == format::JointType::kRevolute;
    scale_[i] = row.scale;
    zero_[i] = row.offset + (revolute_[i] ? row.theta : row.d);
    constant_[i] = constant_[i] * ahead(row, parameters.convention);
    constant_[i + 1] = behind(row, parameters.convention);
  }
  constant_[joints_] = constant_[joints_] * exp(parameters.tool_twist) * from_pose(parameters.tool);
}

void jacobian(const Chain& chain, const ChainFrames<double>& frames, Jacobian& out) noexcept {
  out.setZero();
  for (int i = 0; i < chain.joints(); ++i) {
    const Transformd& X_BP = frames.joint[i];
    const Vector3 axis = X_BP.R.col(2) * chain.scale(i);
    if (chain.revolute(i)) {
      out.col(i).head<3>() = cross<double>(axis, frames.tip.p - X_BP.p);
      out.col(i).tail<3>() = axis;
    } else {
      out.col(i).head<3>() = axis;
    }
  }
}

template <>
Transform<double> Chain::forward(std::span<const double> q) const {
  Transformd out;
  walk(q, [](std::size_t, const Columns<double>&) {}).store(out);
  return out;
}

template <>
void Chain::frames(std::span<const double> q, ChainFrames<double>& out) const {
  walk(q, [&out](std::size_t i, const Columns<double>& X) {
    X.store(out.joint[i]);
  }).store(out.tip);
}

}  // namespace plumb
