// SPDX-License-Identifier: Apache-2.0
#include "check/imagined_poses.hpp"

#include <numeric>

#include "cell/random.hpp"

namespace plumb::offline {
namespace {

constexpr int kPoses = 120;

}  // namespace

Eigen::MatrixXd at_imagined_poses(const Cell& cell, const FitData& data, const ArmState& state,
                                  const std::vector<Parameter>& parameters) {
  Measurements imagined;
  imagined.q.resize(kPoses, cell.joints());
  Random random(1);
  for (Eigen::Index i = 0; i < kPoses; ++i)
    for (int j = 0; j < cell.joints(); ++j) {
      const auto& row = cell.nominal.joints[j];
      imagined.q(i, j) = row.q_min + random.unit() * (row.q_max - row.q_min);
    }
  imagined.p_M = Rows3::Zero(kPoses, 3);
  imagined.has_axis = data.measured->has_axis;
  FitData everywhere;
  everywhere.measured = &imagined;
  everywhere.rows.resize(kPoses);
  std::iota(everywhere.rows.begin(), everywhere.rows.end(), 0);
  everywhere.sigma_m = Rows3::Ones(kPoses, 3);
  if (data.sigma_rad > 0.0) {
    // Radians weigh as if seen a metre away.
    imagined.quat_M = Rows4::Zero(kPoses, 4);
    imagined.quat_M.col(0).setOnes();
    everywhere.sigma_rad = 1.0;
  }
  return evaluate(everywhere, state, parameters).jacobian;
}

}  // namespace plumb::offline
