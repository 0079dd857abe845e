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

Eigen::VectorXd turn_errors(const ArmState& state, const Measurements& measured) {
  const ForwardModel arm(state.arm);
  const auto sensors = temperature_names(state.arm);
  const Transformd X_MB = from_pose(state.X_MB);
  const Matrix3 R_TG = from_pose(state.X_TG).R;
  Eigen::VectorXd out(measured.q.rows());
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const Context context = context_of(measured, i, sensors, X_MB);
    const Matrix3 R_MG = X_MB.R * arm.predict(row_of(measured.q, i), context).X_BT.R * R_TG;
    const auto quat = measured.quat_M.row(i);
    const Matrix3 read = from_pose({{}, {quat(0), quat(1), quat(2), quat(3)}}).R;
    out(i) = rotation_vector(read * R_MG.transpose()).norm();
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
