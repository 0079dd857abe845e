// SPDX-License-Identifier: Apache-2.0
#include "fit/arm_state.hpp"
#include "fit/effect_binding.hpp"

namespace plumb::offline {
namespace {

std::span<const double> row_of(const RowsN& q, Eigen::Index i) {
  return {q.row(i).data(), static_cast<std::size_t>(q.cols())};
}

}  // namespace

Context context_of(const Measurements& at, Eigen::Index row,
                   const std::vector<std::string>& sensors, const Transformd& X_MB) {
  Context out = context_at(at.context, row, sensors);
  const Transformd X_BM = X_MB.inverse();
  for (int k = 0; k < 3; ++k) {
    out.tracker_B[k] = X_BM.p(k);
    out.tracker_up_B[k] = X_BM.R(k, 2);
  }
  return out;
}

namespace {

/// With the effects that a context brings.
Rows3 predict_points_in(const ArmState& state, const Measurements& at) {
  const ForwardModel arm(state.arm);
  const auto sensors = temperature_names(state.arm);
  const Transformd X_MB = from_pose(state.X_MB);
  const Vector3 target_T(state.X_TG.p[0], state.X_TG.p[1], state.X_TG.p[2]);
  Rows3 out(at.q.rows(), 3);
  for (Eigen::Index i = 0; i < at.q.rows(); ++i) {
    const Context context = context_of(at, i, sensors, X_MB);
    out.row(i) = (X_MB * (arm.predict(row_of(at.q, i), context).X_BT * target_T)).transpose();
  }
  return out;
}

}  // namespace

Rows3 predict_points(const ArmState& state, const Measurements& at) {
  Rows3 out =
      state.arm.effects.empty() ? predict_points(state, at.q) : predict_points_in(state, at);
  if (at.departure_B.rows() > 0) out += at.departure_B * from_pose(state.X_MB).R.transpose();
  return out;
}

Rows3 predict_points(const ArmState& state, const RowsN& q) {
  const ForwardModel arm(state.arm);
  const Transformd X_MB = from_pose(state.X_MB);
  const Vector3 target_T(state.X_TG.p[0], state.X_TG.p[1], state.X_TG.p[2]);
  Rows3 out(q.rows(), 3);
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    out.row(i) = (X_MB * (arm.predict(row_of(q, i)).X_BT * target_T)).transpose();
  return out;
}

Rows4 predict_orientations(const ArmState& state, const RowsN& q) {
  const ForwardModel arm(state.arm);
  const Transformd X_MB = from_pose(state.X_MB);
  const Transformd X_TG = from_pose(state.X_TG);
  Rows4 out(q.rows(), 4);
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    const auto quaternion = to_pose(X_MB * arm.predict(row_of(q, i)).X_BT * X_TG).q;
    for (int k = 0; k < 4; ++k) out(i, k) = quaternion[k];
  }
  return out;
}

Rows3 residuals(const Measurements& measured, const Rows3& predicted) {
  Rows3 out = measured.p_M - predicted;
  for (int k = 0; k < 3; ++k)
    if (!measured.has_axis[k]) out.col(k).setZero();
  return out;
}

Rows3 to_base(const ArmState& state, const Rows3& v_M) { return v_M * from_pose(state.X_MB).R; }

}  // namespace plumb::offline
