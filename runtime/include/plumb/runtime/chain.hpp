// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/transform.hpp"
#include "plumb/runtime/wide.hpp"

namespace plumb {

using format::kMaxJoints;

/// Frames of one pose: P_i is the frame just behind the motion of joint i, its z along the joint's
/// axis and its origin on it: behind Rz(q') and ahead of Tz(d) for a revolute joint, behind
/// Rz(theta) Tz(q') for a prismatic one. All in the base frame B of the cell.
struct ChainFrames {
  std::array<Transformd, kMaxJoints> joint;  // X_BPi
  Transformd tip;                            // X_BT
};

/// What the motions of the joints need of them: their axes and a point on each, x, y, z and a
/// number that means nothing.
struct ChainAxes {
  struct Axis {
    alignas(32) std::array<double, 4> along{0.0, 0.0, 1.0, 0.0};  // z of P_i
    alignas(32) std::array<double, 4> through{};                  // its origin
  };
  std::array<Axis, kMaxJoints> joint;
  Transformd tip;  // X_BT
};

/// A point of each frame P_i, in that frame [m].
using JointPoints = std::array<WidePoint, kMaxJoints>;

/// The same in the base frame, and one of the tool as number n [m]: x, y, z and a 1, so that what
/// is multiplied with a mass and summed is a first moment with its mass.
struct ChainPoints {
  alignas(32) std::array<std::array<double, 4>, kMaxJoints + 1> at;
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
  Transformd forward(std::span<const double> q) const noexcept;

  /// The same, with the frame behind every joint.
  void frames(std::span<const double> q, ChainFrames& out) const noexcept;

  /// The same, of each joint its axis alone.
  void frames(std::span<const double> q, ChainAxes& out) const noexcept;

  /// Frames, and where points that are fixed in them and in the tool are in the base frame.
  void frames(std::span<const double> q, const JointPoints& of_joints, const WidePoint& of_tool,
              ChainFrames& out, ChainPoints& points_B) const noexcept;

  /// The constant C_i (0 .. n) of the formula above; frame P_i to the zero position of joint i + 1.
  const Transformd& constant(int i) const noexcept { return constant_[i]; }

  /// What all of these are made of, for the library alone.
  class Walk;

 private:
  /// A C_i that is no more than Tz(d) Tx(a) Rx(alpha), as rows of DH parameters give it.
  struct Link {
    Wide d, a, sin_alpha, cos_alpha;
    bool plain = false;
  };
  void unusual_frames(std::span<const double> q, const JointPoints& of_joints,
                      const WidePoint& of_tool, ChainFrames& out,
                      ChainPoints& points_B) const noexcept;
  static Link link_of(const Transformd& C) noexcept;

  static constexpr std::size_t kRoom = 12;  // joints, in whole registers

  alignas(32) std::array<std::array<double, 4>, 4> base_{};  // columns of C_0: no gathering
  std::array<double, kRoom> scale_{};
  std::array<double, kRoom> zero_{};
  std::array<Link, kMaxJoints + 1> link_{};
  std::array<Transformd, kMaxJoints + 1> constant_{};
  int joints_ = 0;
  bool all_turn_ = false;  // of six joints
  bool usual_ = false;     // and what is between them is plain
  std::array<bool, kMaxJoints> revolute_{};
};

/// Column i: displacement [m] and rotation [rad] of the tip per unit of joint i, base frame.
/// Rows 0-2 translation, rows 3-5 rotation; columns n and up are zero.
using Jacobian = Eigen::Matrix<double, 6, kMaxJoints, Eigen::DontAlign>;
void jacobian(const Chain& chain, const ChainFrames& frames, Jacobian& out) noexcept;

}  // namespace plumb
