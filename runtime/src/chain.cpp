// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/chain.hpp"

#include <algorithm>

#include "chain.hpp"

namespace plumb {
namespace {

Transformd link(const format::JointRow& row) noexcept {
  return translation(row.a, 0.0, 0.0) * rot_x(row.alpha) * rot_y(row.beta);
}

/// The constant part of a DH row that comes before the motion of the joint.
Transformd ahead(const format::JointRow& row, format::Convention convention) noexcept {
  Transformd X = exp(row.pre);
  if (convention == format::Convention::kModified) X = link(row) * X;
  if (row.type == format::JointType::kPrismatic) X = X * rot_z(row.theta);
  return X;
}

/// The constant part of a DH row that comes after the motion of the joint.
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
  for (int i = 0; i <= joints_; ++i) link_[i] = link_of(constant_[i]);
  Columns(constant_[0]).store(base_);
  all_turn_ = joints_ == 6;
  for (int i = 0; i < joints_; ++i) all_turn_ = all_turn_ && revolute_[i];
  fast_path_ = all_turn_;
  for (int i = 1; i < joints_; ++i) fast_path_ = fast_path_ && link_[i].plain;
}

Chain::Link Chain::link_of(const Transformd& C) noexcept {
  const bool about_x = C.R(0, 0) == 1.0 && C.R(1, 0) == 0.0 && C.R(2, 0) == 0.0 &&
                       C.R(0, 1) == 0.0 && C.R(0, 2) == 0.0;
  return {.d = Wide(C.p(2)),
          .a = Wide(C.p(0)),
          .sin_alpha = Wide(C.R(2, 1)),
          .cos_alpha = Wide(C.R(1, 1)),
          .plain = about_x && C.p(1) == 0.0 && C.R(1, 1) == C.R(2, 2) && C.R(1, 2) == -C.R(2, 1)};
}

void jacobian(const Chain& chain, const ChainFrames& frames, Jacobian& out) noexcept {
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

Transformd Chain::forward(std::span<const double> q) const noexcept {
  return Walk(*this).along(q, [](std::size_t, const Columns&) {}).pose();
}

void Chain::frames(std::span<const double> q, ChainFrames& out) const noexcept {
  Walk(*this)
      .along(q, [&out](std::size_t i, const Columns& X) { X.store_over(out.joint[i]); })
      .store(out.tip);
}

void Chain::frames(std::span<const double> q, ChainAxes& out) const noexcept {
  Walk(*this)
      .along(q,
             [&out](std::size_t i, const Columns& X) {
               store(X.z(), out.joint[i].along.data());
               store(X.p(), out.joint[i].through.data());
             })
      .store(out.tip);
}

namespace {

/// Records the frame behind a joint, or that of the tip, and the position of the point fixed to it.
struct PointsAndFrames {
  const JointPoints& of_joints;
  const WidePoint& of_tool;
  ChainFrames& out;
  ChainPoints& points_B;
  int joints;

  void operator()(std::size_t i, const Columns& X) const {
    X.store_over(out.joint[i]);
    store(X.point(of_joints[i]), points_B.at[i].data());
  }
  void operator()(const Columns& X) const {
    X.store(out.tip);
    store(X.point(of_tool), points_B.at[static_cast<std::size_t>(joints)].data());
  }
};

}  // namespace

void Chain::frames(std::span<const double> q, const JointPoints& of_joints,
                   const WidePoint& of_tool, ChainFrames& out,
                   ChainPoints& points_B) const noexcept {
  if (!fast_path_) return general_frames(q, of_joints, of_tool, out, points_B);
  const PointsAndFrames record{of_joints, of_tool, out, points_B, 6};
  record(Walk(*this).fast_path(internal::SixJoints(q.data()), record));
}

/// Kept out of line so that the fast path does not save registers for it.
[[gnu::noinline]] void Chain::general_frames(std::span<const double> q,
                                             const JointPoints& of_joints, const WidePoint& of_tool,
                                             ChainFrames& out,
                                             ChainPoints& points_B) const noexcept {
  const PointsAndFrames record{of_joints, of_tool, out, points_B, joints_};
  record(Walk(*this).general_path(q, record));
}

}  // namespace plumb
