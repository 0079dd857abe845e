// SPDX-License-Identifier: Apache-2.0
#include "fit/step_motions.hpp"

#include "plumb/runtime/chain.hpp"

namespace plumb::offline {

StepMotions::StepMotions(const ArmState& state, const Measurements& measured, const Series& series)
    : rows_(series.first_row), last_rows_(series.last_row), axes_(series.axes()) {
  const Chain chain(state.arm.calibrated);
  const Eigen::Index n = series.size();
  for (int k = 0; k < 3; ++k) mask_(k) = series.has_axis[static_cast<std::size_t>(k)] ? 1.0 : 0.0;
  for (int j = 0; j < chain.joints(); ++j) turns_.push_back(chain.revolute(j));
  error_ = series.error_M.transpose();
  from_middle_.resize(3, n);
  R_MT_.resize(rows_.size());
  joint_.assign(turns_.size(), Eigen::Matrix3Xd(3, n));
  ChainFrames frames;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto q = measured.q.row(rows_[static_cast<std::size_t>(i)]);
    chain.frames({q.data(), static_cast<std::size_t>(q.cols())}, frames);
    const int setup = setup_of(measured, rows_[static_cast<std::size_t>(i)]);
    const Transformd X_MB = from_pose(state.frame(setup));
    const auto& target = state.target(setup).p;
    const Vector3 p_B = frames.tip * Vector3(target[0], target[1], target[2]);
    from_middle_.col(i) = X_MB * p_B;
    R_MT_[static_cast<std::size_t>(i)] = X_MB.R * frames.tip.R;
    for (int j = 0; j < joints(); ++j) {
      const Vector3 z = frames.joint[j].R.col(2) * chain.scale(j);
      const Vector3 motion = turns(j) ? cross<double>(z, p_B - frames.joint[j].p) : z;
      joint_[j].col(i) = mask_.cwiseProduct(X_MB.R * motion);
    }
  }
  from_middle_.colwise() -= Eigen::Vector3d(from_middle_.rowwise().mean());
}

StepMotions::Columns StepMotions::columns(int visit, MotionSource source, int j) const {
  if (source == MotionSource::kJoint) return joint(visit, j);
  if (source == MotionSource::kTool)
    return mask_.asDiagonal() * R_MT_[static_cast<std::size_t>(visit)];
  const Eigen::Vector3d r = from_middle_.col(visit);
  Eigen::Matrix<double, 3, 6> out;
  out.leftCols<3>().setIdentity();
  out.rightCols<3>() << 0, r(2), -r(1), -r(2), 0, r(0), r(1), -r(0), 0;
  return mask_.asDiagonal() * out;
}

}  // namespace plumb::offline
