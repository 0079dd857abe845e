// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/detail/wide.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb {

using format::kMaxJoints;

/// The frames of an arm at one pose, in the base frame B of the cell. P_i is the frame just after
/// the motion of joint i: after Rz(q') and before Tz(d) for a revolute joint, after Rz(theta)
/// Tz(q') for a prismatic one. Its z axis is the joint's axis, and its origin lies on that axis.
struct ChainFrames {
  std::array<Transformd, kMaxJoints> joint;  // X_BPi
  Transformd tip;                            // X_BT
};
// A frame is stored in whole registers and spills one number over the beginning of the next frame,
// so there must be no gaps between frames (docs/runtime-internals.md, "Overlapping writes").
static_assert(sizeof(ChainFrames) == (kMaxJoints + 1) * sizeof(Transformd));
static_assert(sizeof(Transformd) == 12 * sizeof(double));

/// The axis of every joint and a point on it, in the base frame. This is all of ChainFrames that a
/// Jacobian needs. The fourth number of each array is padding with an arbitrary value.
struct ChainAxes {
  struct Axis {
    alignas(32) std::array<double, 4> along{0.0, 0.0, 1.0, 0.0};  // direction: z axis of P_i
    alignas(32) std::array<double, 4> through{};                  // point: origin of P_i [m]
  };
  std::array<Axis, kMaxJoints> joint;
  Transformd tip;  // X_BT
};

/// One point per joint, fixed in frame P_i and given in that frame [m].
using JointPoints = std::array<WidePoint, kMaxJoints>;

/// The joints' points in the base frame, followed by one point of the tool at index n [m]. Each is
/// stored as (x, y, z, 1): multiplied by a mass it gives the first moment and the mass together.
struct ChainPoints {
  alignas(32) std::array<std::array<double, 4>, kMaxJoints + 1> at;
};

/// A serial chain, ready to evaluate: T(q) = C_0 M_1(q_1') C_1 M_2(q_2') ... M_n(q_n') C_n with
/// M = Rz(q') or Tz(q'), q' = scale q + offset + theta (or d). The DH convention, Hayati's beta and
/// all constant twists are folded into the C_i when the chain is built. The Tz(d) of a revolute
/// joint is the beginning of the C_i after it, the Rz(theta) of a prismatic joint is the end of the
/// one before it.
///
/// Cost of an evaluation: n sin_cos and n transform products, whatever q is. Wait-free, any thread.
class Chain {
 public:
  Chain() = default;

  /// Folds the parameters, which is slow compared with an evaluation. Precondition: 1 to 9 joints,
  /// all numbers finite.
  explicit Chain(const format::Chain& parameters) noexcept;

  int joints() const noexcept { return joints_; }
  bool revolute(int i) const noexcept { return revolute_[i]; }

  /// dq'/dq of joint i.
  double scale(int i) const noexcept { return scale_[i]; }

  /// Tool pose X_BT for joint positions q, shape (n,), [rad] or [m]. Neither this nor frames()
  /// checks q: it must have at least n numbers.
  Transformd forward(std::span<const double> q) const noexcept;

  /// The tool pose and the frame after the motion of every joint.
  void frames(std::span<const double> q, ChainFrames& out) const noexcept;

  /// The tool pose and the axis of every joint.
  void frames(std::span<const double> q, ChainAxes& out) const noexcept;

  /// All frames, and the positions in the base frame of one point per joint frame (of_joints, each
  /// in its frame P_i) and of one point of the tool (of_tool, in the tool frame).
  void frames(std::span<const double> q, const JointPoints& of_joints, const WidePoint& of_tool,
              ChainFrames& out, ChainPoints& points_B) const noexcept;

  /// The constant C_i (i = 0 .. n) of the formula above. It leads from frame P_i to the frame of
  /// joint i + 1 in its zero position.
  const Transformd& constant(int i) const noexcept { return constant_[i]; }

  /// The evaluation that forward() and frames() share; used inside the library only.
  class Walk;

 private:
  /// The constants of C_i = Tz(d) Tx(a) Rx(alpha), valid if `plain`: C_i has exactly this form, as
  /// a row of DH parameters without twists gives it.
  struct Link {
    Wide d, a, sin_alpha, cos_alpha;
    bool plain = false;
  };
  void general_frames(std::span<const double> q, const JointPoints& of_joints,
                      const WidePoint& of_tool, ChainFrames& out,
                      ChainPoints& points_B) const noexcept;
  static Link link_of(const Transformd& C) noexcept;

  static constexpr std::size_t kRoom = 12;  // kMaxJoints, rounded up to whole registers

  alignas(32) std::array<std::array<double, 4>, 4> base_{};  // columns of C_0, one per register
  std::array<double, kRoom> scale_{};
  std::array<double, kRoom> zero_{};
  std::array<Link, kMaxJoints + 1> link_{};
  std::array<Transformd, kMaxJoints + 1> constant_{};
  int joints_ = 0;
  bool all_turn_ = false;   // there are six joints, all of them revolute
  bool fast_path_ = false;  // all_turn_, and every link between them is plain: the fast path
  std::array<bool, kMaxJoints> revolute_{};
};

/// Column i is the displacement [m] and rotation [rad] of the tip per unit of joint i, base frame.
/// Rows 0-2 translation, rows 3-5 rotation; columns n and up are zero.
using Jacobian = Eigen::Matrix<double, 6, kMaxJoints, Eigen::DontAlign>;
void jacobian(const Chain& chain, const ChainFrames& frames, Jacobian& out) noexcept;

}  // namespace plumb
