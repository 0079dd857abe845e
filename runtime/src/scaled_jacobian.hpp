// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "lane_order.hpp"
#include "lanes.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::internal {

/// A small motion of the tip in the base frame. Lengths are divided by a reference length, so that
/// they compare with radians. The fourth lanes are arbitrary.
struct TipMotion {
  Lanes translation, rotation;

  friend TipMotion operator-(const TipMotion& a, const TipMotion& b) noexcept {
    return {a.translation - b.translation, a.rotation - b.rotation};
  }
};

/// Steps of the joints: of revolute joints in [rad], of prismatic ones divided by the reference
/// length. The numbers after the last joint, up to the end of its register, are 0.
struct JointSteps : std::array<double, (kMaxJoints + 3) / 4 * 4> {};

/// The Jacobian of the tip, with lengths divided by the reference length.
class ScaledJacobian {
 public:
  /// Computes the translations from `moving` and the rotations from `turning`, two states of one
  /// arm. per_length: 1 / reference length [1/m]. Cost: fixed for a given number of joints.
  void set(const Chain& chain, const ChainAxes& moving, const ChainAxes& turning,
           double per_length) noexcept;

  int joints() const noexcept { return static_cast<int>(joints_); }
  std::span<const TipMotion> columns() const noexcept { return std::span(column_).first(joints_); }

  /// The motion J dq.
  TipMotion times(const JointSteps& dq) const noexcept;

  /// The second-order part of the tip's motion for the step dq, which comes on top of J dq.
  TipMotion curvature(const JointSteps& dq) const noexcept;

  /// Copies the columns into an ordinary matrix; columns n and up are zero.
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
