// SPDX-License-Identifier: Apache-2.0
#include "twin/path.hpp"

#include <gtest/gtest.h>

#include "simulate/simulate.hpp"

namespace plumb::offline::twin {
namespace {

TEST(Path, StaysInItsLimitsAndConfigurationAndAwayFromSingularPoses) {
  const Cell cell = make_demo("clean").cell;
  const NominalArm arm(cell.nominal);
  const Path path = generated_path(cell, 200, 0.5, 9);
  const int configuration = arm.configuration(path.q.row(0).transpose());
  for (int k = 0; k < path.stations(); ++k) {
    const VectorXd q = path.q.row(k).transpose();
    for (int j = 0; j < cell.joints(); ++j) {
      const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
      const double middle = 0.5 * (row.q_min + row.q_max);
      EXPECT_LE(std::abs(q(j) - middle), 0.2500001 * (row.q_max - row.q_min));
    }
    EXPECT_EQ(arm.configuration(q), configuration);
    EXPECT_GT(arm.dexterity(q), 0.05);
  }
  EXPECT_EQ(generated_path(cell, 200, 0.5, 9).q, path.q);
}

TEST(Path, ThatCannotBeIsRefused) {
  Cell cell = make_demo("clean").cell;
  for (auto& row : cell.nominal.joints) row.q_min = row.q_max = 0.0;  // stretched out: singular
  EXPECT_THROW(generated_path(cell, 10, 1.0, 1), Failure);
}

TEST(Move, BeginsAndEndsAtRestAndKeepsItsSpeeds) {
  const Cell cell = make_demo("compliance").cell;
  const NominalArm arm(cell.nominal);
  const Path path = generated_path(cell, 2, 1.0, 4);
  const SpeedLimits limits{.joint_rad_per_s = 1.0, .tool_m_per_s = 0.5, .tool_rad_per_s = 1.0};
  const Move move(arm, path.q.row(0).transpose(), path.q.row(1).transpose(), limits);
  constexpr double kDt = 1e-3;
  double fastest_joint = 0.0, fastest_m = 0.0;
  for (double t = 0.0; t < move.duration_s(); t += kDt) {
    fastest_joint =
        std::max(fastest_joint, (move.at(t + kDt) - move.at(t)).cwiseAbs().maxCoeff() / kDt);
    fastest_m = std::max(fastest_m, (arm.forward(move.at(t + kDt)).translation() -
                                     arm.forward(move.at(t)).translation())
                                            .norm() /
                                        kDt);
  }
  EXPECT_LE(fastest_joint, 1.01);
  EXPECT_LE(fastest_m, 0.5 * 1.05);
  EXPECT_LT((move.at(kDt) - move.at(0.0)).norm(), 1e-6);
  EXPECT_EQ(move.at(0.0), path.q.row(0).transpose());
  EXPECT_TRUE(move.at(1e9).isApprox(path.q.row(1).transpose(), 1e-12));
}

}  // namespace
}  // namespace plumb::offline::twin
