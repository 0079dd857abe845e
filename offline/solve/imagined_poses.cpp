// SPDX-License-Identifier: Apache-2.0
#include "solve/imagined_poses.hpp"

#include <numeric>

#include "cell/random.hpp"
#include "solve/constants.hpp"
#include "solve/evaluation.hpp"

namespace plumb::offline {
Eigen::MatrixXd at_imagined_poses(const Cell& cell, const FitData& data, const ArmState& state,
                                  const std::vector<Parameter>& parameters) {
  Measurements imagined;
  const int poses = kImaginedPoses * state.setups();
  imagined.q.resize(poses, cell.joints());
  for (int i = 0; i < poses; ++i) imagined.setup.push_back(i / kImaginedPoses);
  Random random(1);
  for (Eigen::Index i = 0; i < poses; ++i)
    for (int j = 0; j < cell.joints(); ++j) {
      const auto& row = cell.nominal.joints[j];
      imagined.q(i, j) = row.q_min + random.unit() * (row.q_max - row.q_min);
    }
  imagined.p_M = Rows3::Zero(poses, 3);
  imagined.has_axis = data.measured->has_axis;
  FitData everywhere;
  everywhere.measured = &imagined;
  everywhere.rows.resize(static_cast<std::size_t>(poses));
  std::iota(everywhere.rows.begin(), everywhere.rows.end(), 0);
  everywhere.sigma_m = Rows3::Ones(poses, 3);
  if (data.sigma_rad > 0.0) {
    // One radian counts as much as one metre.
    imagined.quat_M = Rows4::Zero(poses, 4);
    imagined.quat_M.col(0).setOnes();
    everywhere.sigma_rad = 1.0;
  }
  // Effects are left out: loads, temperatures and directions are not known at imagined poses.
  ArmState bare = state;
  bare.arm.effects.clear();
  return evaluate(everywhere, bare, parameters).jacobian;
}

}  // namespace plumb::offline
