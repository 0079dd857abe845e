// SPDX-License-Identifier: Apache-2.0
#include "solve/frame_start.hpp"

#include "arm/measured_arm.hpp"
#include "cell/setups.hpp"
#include "numbers/rotation_fit.hpp"

namespace plumb::offline {

format::Pose align(const Rows3& p_B, const Rows3& p_M) {
  const Eigen::RowVector3d mean_B = p_B.colwise().mean();
  const Eigen::RowVector3d mean_M = p_M.colwise().mean();
  const Matrix3 H = (p_M.rowwise() - mean_M).transpose() * (p_B.rowwise() - mean_B);
  Transformd X_MB;
  X_MB.R = nearest_rotation(H);
  X_MB.p = mean_M.transpose() - X_MB.R * mean_B.transpose();
  return to_pose(X_MB);
}

void place_as_given(const MeasurementSettings& settings, ArmState& state) {
  state.more.clear();
  for (int k = 0; k < setup_count(settings); ++k) {
    const Setup rule = setup_rule(settings, k);
    if (k > 0) state.more.push_back({frame_root(settings, k), target_root(settings, k), {}, {}});
    if (state.frame_of(k) == k) state.frame(k) = rule.X_MB;
    if (state.target_of(k) == k) state.target(k).p = rule.target_T;
    state.length(k) = rule.length_m;
  }
}

std::array<double, 4> align_target(const ArmState& state, const Measurements& measured,
                                   const std::vector<int>& rows) {
  // The mean of quaternions is the leading eigenvector of sum q q^T [Markley 2007].
  const MeasuredArm arm(state.arm);
  const Transformd X_MB = from_pose(state.frame(rows.empty() ? 0 : setup_of(measured, rows[0])));
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (int i : rows) {
    const std::span<const double> q(measured.q.row(i).data(),
                                    static_cast<std::size_t>(measured.q.cols()));
    const auto m = measured.quat_M.row(i);
    Transformd X_MG = from_pose({{}, {m(0), m(1), m(2), m(3)}});
    X_MG.p.setZero();
    const auto q_TG = to_pose((X_MB * arm.predict(q, {}).X_BT).inverse() * X_MG).q;
    const Eigen::Map<const Eigen::Vector4d> v(q_TG.data());
    sum += v * v.transpose();
  }
  const Eigen::Vector4d mean = mean_quaternion(sum);
  return {mean(0), mean(1), mean(2), mean(3)};
}

}  // namespace plumb::offline
