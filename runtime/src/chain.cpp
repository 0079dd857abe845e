// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/chain.hpp"

#include <algorithm>

#include "lanes.hpp"
#include "sin_cos_packed.hpp"

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
  for (int i = 0; i <= joints_; ++i) link_[i] = link_of(constant_[i]);
  Columns(constant_[0]).store(base_);
  usual_ = revolute_[0];
  for (int i = 1; i < joints_; ++i) usual_ = usual_ && revolute_[i] && link_[i].plain;
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

/// One way along the chain.
class Chain::Walk {
 public:
  Walk(const Chain& chain, std::span<const double> q) noexcept : chain_(chain) {
    const double* at = q.data();
    if (chain.joints_ == 6)
      prepare<6>(at);
    else
      prepare<0>(at);
  }

  /// behind_joint(i, X_BPi) for every joint; returns X_BT.
  template <class F>
  Columns along(F behind_joint) const noexcept {
    if (chain_.joints_ != 6) return along<0, false>(behind_joint);
    return chain_.usual_ ? along<6, true>(behind_joint) : along<6, false>(behind_joint);
  }

 private:
  /// Positions, sines and cosines. kJoints: known when compiled, so that the loops are unrolled; 0:
  /// any number. What goes into a register is gathered there: from memory just written in parts it
  /// would have to wait.
  template <int kJoints>
  void prepare(const double* q) noexcept {
    const auto n = static_cast<std::size_t>(kJoints > 0 ? kJoints : chain_.joints_);
    for (std::size_t i = 0; i < n; i += kPackedLanes) {
      const Packed at = load_some(q + i, n - i) * load(&chain_.scale_[i]) + load(&chain_.zero_[i]);
      Packed sin, cos;
      portable::sin_cos_packed(at, sin, cos);
      store(at, &position_[i]);
      store(sin, &sin_[i]);
      store(cos, &cos_[i]);
    }
  }

  /// kUsual: nothing of joints and links need be asked.
  template <int kJoints, bool kUsual, class F>
  Columns along(F behind_joint) const noexcept {
    const auto n = static_cast<std::size_t>(kJoints > 0 ? kJoints : chain_.joints_);
    Columns X(chain_.base_);
#pragma GCC unroll 6
    for (std::size_t i = 0; i < n; ++i) {
      if (kUsual || chain_.revolute_[i])
        X.turn(sin_[i], cos_[i]);
      else
        X.slide(position_[i]);
      behind_joint(i, X);
      const Link& link = chain_.link_[i + 1];
      if ((kUsual && i + 1 < n) || link.plain)
        X.append_link(link.d, link.a, link.sin_alpha, link.cos_alpha);
      else
        X.append(chain_.constant_[i + 1]);
    }
    return X;
  }

  const Chain& chain_;
  alignas(32) std::array<double, kRoom> position_, sin_, cos_;
};

Transformd Chain::forward(std::span<const double> q) const noexcept {
  return Walk(*this, q).along([](std::size_t, const Columns&) {}).pose();
}

void Chain::frames(std::span<const double> q, ChainFrames& out) const noexcept {
  Walk(*this, q)
      .along([&out](std::size_t i, const Columns& X) { X.store_over(out.joint[i]); })
      .store(out.tip);
}

void Chain::frames(std::span<const double> q, ChainAxes& out) const noexcept {
  Walk(*this, q)
      .along([&out](std::size_t i, const Columns& X) {
        store(X.z(), out.joint[i].along.data());
        store(X.p(), out.joint[i].through.data());
      })
      .store(out.tip);
}

void Chain::frames(std::span<const double> q, const JointPoints& of_joints,
                   const WidePoint& of_tool, ChainFrames& out,
                   ChainPoints& points_B) const noexcept {
  const Columns tip = Walk(*this, q).along([&](std::size_t i, const Columns& X) {
    X.store_over(out.joint[i]);
    store(X.point(of_joints[i]), points_B.at[i].data());
  });
  tip.store(out.tip);
  store(tip.point(of_tool), points_B.at[static_cast<std::size_t>(joints_)].data());
}

}  // namespace plumb
