// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "lane_order.hpp"
#include "lanes.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::internal {

/// A small motion of the tip in the base frame, lengths divided by a length, so that metres and
/// radians compare. The fourth lanes mean nothing.
struct TipMotion {
  Lanes translation, rotation;

  friend TipMotion operator-(const TipMotion& a, const TipMotion& b) noexcept {
    return {a.translation - b.translation, a.rotation - b.rotation};
  }
};

/// Steps of the joints: turning ones in [rad], sliding ones divided by the same length; 0 behind
/// the last joint, up to the end of its register.
struct JointSteps : std::array<double, (kMaxJoints + 3) / 4 * 4> {};

/// How the tip moves with each joint.
class ScaledJacobian {
 public:
  /// Translations by `moving`, rotations by `turning`, two states of one arm.
  /// per_length: 1 / length, [1/m]. Cost: fixed for a given number of joints.
  void set(const Chain& chain, const ChainAxes& moving, const ChainAxes& turning,
           double per_length) noexcept;

  int joints() const noexcept { return static_cast<int>(joints_); }
  std::span<const TipMotion> columns() const noexcept { return std::span(column_).first(joints_); }

  /// J dq.
  TipMotion times(const JointSteps& dq) const noexcept;

  /// What the tip moves beyond J dq along dq, to the second order.
  TipMotion curvature(const JointSteps& dq) const noexcept;

  /// The same numbers, row by row; columns n and up are zero.
  void copy_to(Jacobian& out) const noexcept;

 private:
  template <std::size_t kJoints>
  void set_columns(const Chain& chain, const ChainAxes& moving, const ChainAxes& turning,
                   double per_length) noexcept;
  template <std::size_t kJoints>
  TipMotion curvature_along(const JointSteps& dq) const noexcept;

  std::array<TipMotion, kMaxJoints> column_;
  std::size_t joints_;
};

}  // namespace plumb::internal
