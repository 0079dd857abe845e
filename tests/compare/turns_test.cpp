// SPDX-License-Identifier: Apache-2.0
// Errors of measured orientations: how much of them goes about each joint, and what a comparison
// says of them.
#include <gtest/gtest.h>

#include <cmath>

#include "arm/joint_turns.hpp"
#include "arm/predicted_points.hpp"
#include "compare/comparison.hpp"
#include "fit/fit_cell.hpp"
#include "simulate/simulate.hpp"
#include "simulate/study_arms.hpp"

namespace plumb::offline::compare {
namespace {

/// A heavy arm measured with its orientations, calibrated.
struct TurnedArm {
  explicit TurnedArm(const std::vector<std::string>& hidden, std::uint64_t seed = 1) {
    cell = sim::heavy_arm();
    cell.measurement.sigma_m = 50e-6;
    cell.measurement.sigma_rad = 20e-6;
    SimulationPlan plan;
    plan.poses = 150;
    plan.noise_m = 50e-6;
    plan.noise_rad = 20e-6;
    plan.seed = seed;
    plan.truth.geometry_m = plan.truth.geometry_rad = 0.3e-3;
    plan.truth.effects = hidden;
    static_cast<Measurements&>(measured) = simulate(cell, plan).measured;
    fit = fit_cell(cell, measured);
  }
  Cell cell;
  MeasurementFiles measured;
  Fit fit;
};

/// The reflector reads what it would read if joint j stood elsewhere by a small angle.
TEST(JointTurns, OfOneJointGoAboutItsAxisByItsAngle) {
  constexpr double kTurn = 1e-5;
  const TurnedArm made({});
  const ArmState& state = made.fit.calibration.state;
  for (int j = 0; j < made.cell.joints(); ++j) {
    Measurements moved = made.measured;
    moved.q.col(j).array() += kTurn;
    const Rows3 turned = turns_of_target(state, made.measured) - turns_of_target(state, moved);
    const RowsN about = turns_about_joints(state, made.measured, turned);
    for (int i = 0; i < made.measured.size(); ++i) {
      EXPECT_NEAR(turned.row(i).norm(), kTurn, 1e-3 * kTurn);
      EXPECT_NEAR(about(i, j), kTurn, 1e-3 * kTurn) << "joint " << j << ", row " << i;
      EXPECT_LE(about.row(i).cwiseAbs().maxCoeff(), kTurn * 1.001);
    }
  }
}

TEST(Turns, OfAJointWhoseGearErrsAreAboutItsAxis) {
  const TurnedArm made({"gear_ripple:J6=300urad"});
  const Turns turns = comparison(made.cell, made.measured, made.fit).turns;
  ASSERT_EQ(turns.poses.size(), 150U);
  EXPECT_GT(turns.poses.front().error_rad, 100e-6);
  EXPECT_GE(turns.poses.front().error_rad, turns.poses.back().error_rad);
  ASSERT_TRUE(turns.axis);
  EXPECT_EQ(turns.axis->joint, 5);
  EXPECT_GT(turns.axis->share, 0.9);
  EXPECT_LE(turns.axis->share, 1.0);
}

TEST(Turns, OfNoiseAreAboutNoAxisAndDependOnNothing) {
  int said = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const TurnedArm made({}, seed);
    const Turns turns = comparison(made.cell, made.measured, made.fit).turns;
    for (const auto& profile : turns.profiles) said += profile.matters;
    for (const auto& share : turns.joints) said += share.matters;
    said += turns.axis.has_value();
  }
  EXPECT_EQ(said, 0);
}

TEST(Turns, AreNoneWhereOrientationsAreNotFitted) {
  TurnedArm made({});
  made.cell.measurement.sigma_rad.reset();
  made.fit = fit_cell(made.cell, made.measured);
  const Turns turns = comparison(made.cell, made.measured, made.fit).turns;
  EXPECT_TRUE(turns.poses.empty());
  EXPECT_FALSE(turns.axis);
}

}  // namespace
}  // namespace plumb::offline::compare
