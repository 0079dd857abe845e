// SPDX-License-Identifier: Apache-2.0
#include "scaled_jacobian.hpp"

#include "pose_lanes.hpp"

namespace plumb::internal {

void ScaledJacobian::set(const Chain& chain, const ChainAxes& moving, const ChainAxes& turning,
                         double per_length) noexcept {
  joints_ = static_cast<std::size_t>(chain.joints());
  if (joints_ == 6)
    set_columns<6>(chain, moving, turning, per_length);
  else
    set_columns<0>(chain, moving, turning, per_length);
}

/// kJoints: number of joints as a compile-time constant, so that the loop is unrolled; 0 for any
/// number.
template <std::size_t kJoints>
void ScaledJacobian::set_columns(const Chain& chain, const ChainAxes& moving,
                                 const ChainAxes& turning, double per_length) noexcept {
  const std::size_t n = kJoints > 0 ? kJoints : joints_;
  const Lanes tip = origin(moving.tip), none{0.0, 0.0, 0.0, 0.0};
#pragma GCC unroll 6
  for (std::size_t j = 0; j < n; ++j) {
    const double scale = chain.scale(static_cast<int>(j));
    const ChainAxes::Axis& axis = moving.joint[j];
    const Lanes along = lanes(axis.along.data()) * scale;
    if (chain.revolute(static_cast<int>(j)))
      column_[j] = {cross(along, tip - lanes(axis.through.data())) * per_length,
                    lanes(turning.joint[j].along.data()) * scale};
    else
      column_[j] = {along, none};
  }
}

TipMotion ScaledJacobian::times(const JointSteps& dq) const noexcept {
  TipMotion out{Lanes{0.0, 0.0, 0.0, 0.0}, Lanes{0.0, 0.0, 0.0, 0.0}};
  for (std::size_t j = 0; j < joints_; ++j) {
    out.translation = out.translation + column_[j].translation * dq[j];
    out.rotation = out.rotation + column_[j].rotation * dq[j];
  }
  return out;
}

TipMotion ScaledJacobian::curvature(const JointSteps& dq) const noexcept {
  return joints_ == 6 ? curvature_along<6>(dq) : curvature_along<0>(dq);
}

// With w_j and v_j the columns' rotations and translations, dv_j/dq_i = w_i x v_j for i <= j and
// w_j x v_i beyond, dw_j/dq_i = w_i x w_j for i < j. Summed along the arm, W = sum_{i<j} w_i dq_i:
//   translation  1/2 sum_j (2 W + w_j dq_j) x v_j dq_j
//   rotation     1/2 sum_j W x w_j dq_j
template <std::size_t kJoints>
TipMotion ScaledJacobian::curvature_along(const JointSteps& dq) const noexcept {
  const std::size_t n = kJoints > 0 ? kJoints : joints_;
  Lanes W{0.0, 0.0, 0.0, 0.0};
  TipMotion sum{W, W};
#pragma GCC unroll 6
  for (std::size_t j = 0; j < n; ++j) {
    const Lanes w = column_[j].rotation * dq[j], v = column_[j].translation * dq[j];
    sum.rotation = sum.rotation + cross_turned(W, w);
    sum.translation = sum.translation + cross_turned(W + W + w, v);
    W = W + w;
  }
  return {turned(sum.translation) * 0.5, turned(sum.rotation) * 0.5};
}

void ScaledJacobian::copy_to(Jacobian& out) const noexcept {
  out.setZero();
  for (std::size_t j = 0; j < joints_; ++j)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      out(row, column) = column_[j].translation[i];
      out(row + 3, column) = column_[j].rotation[i];
    }
}

}  // namespace plumb::internal
