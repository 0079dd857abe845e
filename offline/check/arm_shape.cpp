// SPDX-License-Identifier: Apache-2.0
#include "check/arm_shape.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "check/constants.hpp"
#include "numbers/rotation_fit.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

bool lie_in_a_plane(const Measurements& measured, const std::vector<int>& rows) {
  const Rows3 points = measured.p_M(rows, Eigen::all);
  const Rows3 centred = points.rowwise() - points.colwise().mean();
  const Eigen::Matrix3d spread = centred.transpose() * centred;
  const Eigen::Vector3d w = symmetric_eigenvalues(spread);
  return std::max(0.0, w(0)) < check::kFlatShare * check::kFlatShare * w(2);
}

}  // namespace

ArmShape arm_shape(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
                   const ArmState& state) {
  ArmShape out;
  const Chain chain(state.arm.calibrated);
  ChainFrames frames;
  const auto q = measured.q.row(rows.front());
  chain.frames({q.data(), static_cast<std::size_t>(q.cols())}, frames);
  const int n = cell.joints();
  for (int j = 0; j + 1 < n; ++j) {
    const Vector3 a = frames.joint[j].R.col(2), b = frames.joint[j + 1].R.col(2);
    out.angle_to_next.push_back(std::atan2(a.cross(b).norm(), std::abs(a.dot(b))));
  }
  for (int j = 0; j < n; ++j) {
    double low = q(j), high = q(j);
    for (const int i : rows) {
      low = std::min(low, measured.q(i, j));
      high = std::max(high, measured.q(i, j));
    }
    out.used.push_back(high - low);
    const auto& row = cell.nominal.joints[j];
    out.limits.push_back(row.q_max - row.q_min);
  }
  const Vector3 tip = frames.tip * Vector3(state.X_TG.p[0], state.X_TG.p[1], state.X_TG.p[2]);
  const auto& last = frames.joint[n - 1];
  out.reflector_off_last_axis_m = (tip - last.p).cross(last.R.col(2)).norm();
  out.flat = lie_in_a_plane(measured, rows);
  return out;
}

}  // namespace plumb::offline
