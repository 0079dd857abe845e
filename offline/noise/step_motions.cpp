// SPDX-License-Identifier: Apache-2.0
#include "noise/step_motions.hpp"

#include <utility>

namespace plumb::offline {

StepMotions::StepMotions(const ArmState& state, const Measurements& measured, Series series)
    : measured_(measured),
      chain_(state.arm.calibrated),
      rows_(std::move(series.first_row)),
      last_rows_(std::move(series.last_row)),
      axes_(series.axes()),
      error_(series.error_M.transpose()) {
  series.error_M.resize(0, 3);
  const auto n = static_cast<Eigen::Index>(rows_.size());
  for (int k = 0; k < 3; ++k) mask_(k) = series.has_axis[static_cast<std::size_t>(k)] ? 1.0 : 0.0;
  for (int j = 0; j < chain_.joints(); ++j) turns_.push_back(chain_.revolute(j));
  for (int k = 0; k < state.setups(); ++k) X_MB_.push_back(from_pose(state.frame(k)));
  from_middle_.resize(3, n);
  joint_.assign(turns_.size(), Eigen::Matrix3Xd(3, n));
  ChainFrames at;
  for (int i = 0; i < size(); ++i) {
    const int setup = frames(i, at);
    const Transformd& X_MB = X_MB_[static_cast<std::size_t>(setup)];
    const auto& target = state.target(setup).p;
    const Vector3 p_B = at.tip * Vector3(target[0], target[1], target[2]);
    from_middle_.col(i) = X_MB * p_B;
    for (int j = 0; j < joints(); ++j) {
      const Vector3 z = at.joint[j].R.col(2) * chain_.scale(j);
      const Vector3 motion = turns(j) ? cross<double>(z, p_B - at.joint[j].p) : z;
      joint_[j].col(i) = mask_.cwiseProduct(X_MB.R * motion);
    }
  }
  from_middle_.colwise() -= Eigen::Vector3d(from_middle_.rowwise().mean());
}

int StepMotions::frames(int visit, ChainFrames& out) const {
  const int row = rows_[static_cast<std::size_t>(visit)];
  const auto q = measured_.q.row(row);
  chain_.frames({q.data(), static_cast<std::size_t>(q.cols())}, out);
  return setup_of(measured_, row);
}

StepMotions::Columns StepMotions::columns(int visit, MotionSource source, int j) const {
  if (source == MotionSource::kJoint) return joint(visit, j);
  if (source == MotionSource::kTool) {
    ChainFrames at;
    const auto setup = static_cast<std::size_t>(frames(visit, at));
    const Eigen::Matrix3d R_MT = X_MB_[setup].R * at.tip.R;
    return mask_.asDiagonal() * R_MT;
  }
  const Eigen::Vector3d r = from_middle_.col(visit);
  Eigen::Matrix<double, 3, 6> out;
  out.leftCols<3>().setIdentity();
  out.rightCols<3>() << 0, r(2), -r(1), -r(2), 0, r(0), r(1), -r(0), 0;
  return mask_.asDiagonal() * out;
}

}  // namespace plumb::offline
