// SPDX-License-Identifier: Apache-2.0
#include "check/linear_placement.hpp"

#include <gtest/gtest.h>

#include <random>

#include "cell/cell.hpp"
#include "check/arm_sweep.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

/// Joint positions and points of a random arm; `noise` [m] of each coordinate.
Measurements of_arm(const Cell& cell, std::uint64_t seed, double noise) {
  SimulationPlan plan;
  plan.poses = 24;
  plan.seed = seed;
  Measurements out = simulate(cell, plan).measured;
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal(0.0, noise);
  for (double& coordinate : out.p_M.reshaped()) coordinate += normal(random);
  return out;
}

TEST(QuickMisfit, IsThatOfThePlacementForEveryReading) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
    const Measurements measured = of_arm(cell, seed, seed % 2 == 0 ? 0.0 : 0.01);
    const std::array<bool, 3> axes{true, true, seed % 3 != 0};
    LinearPlacer placer(measured.p_M, axes);
    ArmSweep(cell.nominal, measured.q, 1)
        .run([&](const auto&, const auto&, const std::vector<Transformd>& X_BT) {
          const double misfit = placer.place(X_BT).misfit;
          EXPECT_NEAR(placer.quick_misfit(X_BT), misfit, 1e-6 * (1.0 + misfit)) << seed;
        });
  }
}

TEST(QuickMisfit, OfPointsInOnePlaneIsThatOfThePlacement) {
  const Cell cell = random_cell(2, 6, format::Convention::kModified, ArmKind::kRevolute);
  Measurements measured = of_arm(cell, 2, 0.0);
  measured.p_M.col(2).setConstant(0.3);
  LinearPlacer placer(measured.p_M, {true, true, true});
  ArmSweep(cell.nominal, measured.q, 0)
      .run([&](const auto&, const auto&, const std::vector<Transformd>& X_BT) {
        const double misfit = placer.place(X_BT).misfit;
        EXPECT_NEAR(placer.quick_misfit(X_BT), misfit, 1e-6 * (1.0 + misfit));
      });
}

TEST(ArmSweepPoses, AreThoseOfTheVisitToTheSameBits) {
  const Cell cell = random_cell(3, 5, format::Convention::kModified, ArmKind::kRevolute);
  const Measurements measured = of_arm(cell, 3, 0.0);
  const ArmSweep again(cell.nominal, measured.q, 0);
  ArmSweep(cell.nominal, measured.q, 0)
      .run(
          [&](const std::vector<bool>& reversed, const auto&, const std::vector<Transformd>& X_BT) {
            const auto poses = again.poses(reversed);
            for (std::size_t i = 0; i < poses.size(); ++i) {
              EXPECT_EQ(poses[i].p, X_BT[i].p);
              EXPECT_EQ(poses[i].R, X_BT[i].R);
            }
          });
}

}  // namespace
}  // namespace plumb::offline
