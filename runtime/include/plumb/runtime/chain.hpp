// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/lanes.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb {

using format::kMaxJoints;

/// Frames of one pose: P_i is the frame just behind the motion of joint i, its z along the joint's
/// axis and its origin on it: behind Rz(q') and ahead of Tz(d) for a revolute joint, behind
/// Rz(theta) Tz(q') for a prismatic one. All in the base frame B of the cell.
template <class S>
struct ChainFrames {
  std::array<Transform<S>, kMaxJoints> joint;  // X_BPi
  Transform<S> tip;                            // X_BT
};

/// Serial chain, ready to evaluate: T(q) = C_0 M_1(q_1') C_1 M_2(q_2') ... M_n(q_n') C_n with
/// M = Rz(q') or Tz(q'), q' = scale q + offset + theta (or d). The DH convention, Hayati's beta and
/// all constant twists are folded into the C_i when the chain is built: a revolute joint's Tz(d)
/// begins the C_i behind it, a prismatic joint's Rz(theta) ends the one ahead of it.
///
/// Cost of an evaluation: n sin_cos and n transform products, whatever q is. Wait-free, any thread.
class Chain {
 public:
  Chain() = default;

  /// Folds the parameters; slow compared with an evaluation. Precondition: 1 to 9 joints, finite.
  explicit Chain(const format::Chain& parameters) noexcept;

  int joints() const noexcept { return joints_; }
  bool revolute(int i) const noexcept { return revolute_[i]; }

  /// dq'/dq of joint i.
  double scale(int i) const noexcept { return scale_[i]; }

  /// Tool pose X_BT for joint positions q, shape (n,), [rad] or [m].
  template <class S>
  Transform<S> forward(std::span<const S> q) const;

  /// The same, with the frame behind every joint.
  template <class S>
  void frames(std::span<const S> q, ChainFrames<S>& out) const;

  /// The constant C_i (0 .. n) of the formula above; frame P_i to the zero position of joint i + 1.
  const Transformd& constant(int i) const noexcept { return constant_[i]; }

 private:
  template <int kJoints, class S, class F>
  Columns<S> walk(std::span<const S> q, F behind_joint) const;
  template <class S, class F>
  Columns<S> walk(std::span<const S> q, F behind_joint) const;

  int joints_ = 0;
  std::array<bool, kMaxJoints> revolute_{};
  std::array<double, kMaxJoints> scale_{};
  std::array<double, kMaxJoints> zero_{};
  std::array<Transformd, kMaxJoints + 1> constant_{};
};

/// Column i: displacement [m] and rotation [rad] of the tip per unit of joint i, base frame.
/// Rows 0-2 translation, rows 3-5 rotation; columns n and up are zero.
using Jacobian = Eigen::Matrix<double, 6, kMaxJoints, Eigen::DontAlign>;
void jacobian(const Chain& chain, const ChainFrames<double>& frames, Jacobian& out) noexcept;

// --- implementation ------------------------------------------------------------------------------

/// behind_joint(i, X_BPi) for every joint; returns X_BT. kJoints: known when compiled, so that the
/// loops are unrolled; 0: joints().
template <int kJoints, class S, class F>
Columns<S> Chain::walk(std::span<const S> q, F behind_joint) const {
  using portable::sin_cos;
  constexpr std::size_t kLanes = portable::kSinCosLanes;
  constexpr std::size_t kMost = kJoints > 0 ? kJoints : kMaxJoints;
  constexpr std::size_t kRoom = (kMost + kLanes - 1) / kLanes * kLanes;
  const auto n = static_cast<std::size_t>(kJoints > 0 ? kJoints : joints_);
  std::array<S, kRoom> position, sin, cos;
  for (std::size_t i = 0; i < n; ++i) position[i] = q[i] * scale_[i] + zero_[i];
  for (std::size_t i = n; i < kRoom; ++i) position[i] = S(0.0);
  sin_cos(std::span<const S>(position).first(n), sin.data(), cos.data());
  Columns<S> X(constant_[0]);
  for (std::size_t i = 0; i < n; ++i) {
    if (revolute_[i])
      X.turn(sin[i], cos[i]);
    else
      X.slide(position[i]);
    behind_joint(i, X);
    X.append(constant_[i + 1]);
  }
  return X;
}

template <class S, class F>
Columns<S> Chain::walk(std::span<const S> q, F behind_joint) const {
  return joints_ == 6 ? walk<6>(q, behind_joint) : walk<0>(q, behind_joint);
}

template <class S>
Transform<S> Chain::forward(std::span<const S> q) const {
  Transform<S> out;
  walk(q, [](std::size_t, const Columns<S>&) {}).store(out);
  return out;
}

template <class S>
void Chain::frames(std::span<const S> q, ChainFrames<S>& out) const {
  walk(q, [&out](std::size_t i, const Columns<S>& X) { X.store(out.joint[i]); }).store(out.tip);
}

// Of doubles: in the archive only, since how numbers are packed depends on what it is compiled for.
template <>
Transform<double> Chain::forward(std::span<const double> q) const;
template <>
void Chain::frames(std::span<const double> q, ChainFrames<double>& out) const;

}  // namespace plumb
