// SPDX-License-Identifier: Apache-2.0
#include "arm/joint_turns.hpp"

#include "plumb/runtime/chain.hpp"

namespace plumb::offline {

RowsN turns_about_joints(const ArmState& state, const Measurements& at, const Rows3& turned_G) {
  const Chain chain(state.arm.calibrated);
  RowsN out = RowsN::Zero(at.q.rows(), at.q.cols());
  ChainFrames frames;
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    chain.frames({at.q.row(i).data(), static_cast<std::size_t>(at.q.cols())}, frames);
    const Matrix3 R_TG = from_pose(state.target(setup_of(at, i))).R;
    const Vector3 turn_B = frames.tip.R * (R_TG * turned_G.row(i).transpose());
    for (int j = 0; j < chain.joints(); ++j)
      if (chain.revolute(j)) out(i, j) = frames.joint[j].R.col(2).dot(turn_B);
  }
  return out;
}

}  // namespace plumb::offline
