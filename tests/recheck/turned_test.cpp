// SPDX-License-Identifier: Apache-2.0
// Orientations in a recheck: positions agree with the calibration, and something turns the tool.
#include "recheck/turned.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "fit/fit_cell.hpp"
#include "recheck/recheck.hpp"
#include "simulate/simulate.hpp"
#include "simulate/study_arms.hpp"

namespace plumb::offline::recheck {
namespace {

/// A heavy arm calibrated with orientations; every pose is measured twice, and the second readings
/// of some are the new ones.
struct Turning : testing::Test {
  Turning() {
    cell = sim::heavy_arm();
    cell.tolerance_m = 0.3e-3;
    cell.measurement.sigma_m = 50e-6;
    cell.measurement.sigma_rad = 20e-6;
    SimulationPlan plan;
    plan.poses = 120;
    plan.revisits = 24;
    plan.noise_m = 50e-6;
    plan.noise_rad = 20e-6;
    plan.truth.geometry_m = plan.truth.geometry_rad = 0.3e-3;
    const Measurements all = simulate(cell, plan).measured;
    std::vector<int> first(120), again(24);
    for (int i = 0; i < 120; ++i) first[static_cast<std::size_t>(i)] = i;
    for (int i = 0; i < 24; ++i) again[static_cast<std::size_t>(i)] = 120 + i;
    own = pick(all, first);
    rows = pick(all, again);
    run.fit = fit_cell(cell, own);
  }

  /// Turns the reflector that row i reads by so much about its z axis.
  void turn(Eigen::Index i, double angle_rad) {
    auto quat = rows.quat_M.row(i);
    const Eigen::Quaterniond read(quat(0), quat(1), quat(2), quat(3));
    const Eigen::Quaterniond now =
        read * Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()));
    quat << now.w(), now.x(), now.y(), now.z();
  }
  Recheck recheck(const Assumed& assumed = {}) const {
    return recheck_run(cell, run, run, own, rows, assumed);
  }

  Cell cell;
  Measurements own, rows;
  offline::Run run;
};

TEST_F(Turning, IsNotSaidWhereNothingTurns) {
  const Recheck out = recheck();
  ASSERT_TRUE(out.turns.judged());
  EXPECT_FALSE(out.turns.turned());
  EXPECT_NEAR(out.turns.now.mean, out.turns.then.mean, 0.4 * out.turns.then.mean);
  EXPECT_NE(out.verdict, Recheck::Verdict::kChanged);
}

TEST_F(Turning, OfTheReflectorIsOneTurnForAllReadings) {
  for (int i = 0; i < rows.size(); ++i) turn(i, 300e-6);
  const Recheck out = recheck();
  EXPECT_EQ(out.verdict, Recheck::Verdict::kChanged);
  EXPECT_TRUE(out.found.empty()) << "positions agree";
  EXPECT_TRUE(out.turns.turned());
  EXPECT_TRUE(out.turns.is_constant);
  EXPECT_NEAR(out.turns.constant_rad, 300e-6, 30e-6);
}

/// A gear of the last joint that began to err.
TEST_F(Turning, ByPlaceIsNoConstantTurn) {
  for (int i = 0; i < rows.size(); ++i) turn(i, 400e-6 * std::sin(7.0 * rows.q(i, 5)));
  const Recheck out = recheck();
  EXPECT_EQ(out.verdict, Recheck::Verdict::kChanged);
  EXPECT_TRUE(out.turns.turned());
  EXPECT_FALSE(out.turns.is_constant);
}

/// How a new reflector is turned nobody knows.
TEST_F(Turning, OfANewReflectorSaysNothing) {
  for (int i = 0; i < rows.size(); ++i) turn(i, 0.3);
  const Recheck out = recheck({.new_frame = false, .new_target = true});
  ASSERT_TRUE(out.turns.judged());
  EXPECT_FALSE(out.turns.turned());
}

TEST_F(Turning, OfOneBadReadingCountsLittle) {
  turn(3, 5e-3);
  EXPECT_FALSE(recheck().turns.turned());
}

TEST_F(Turning, IsNotJudgedWithoutOrientations) {
  rows.quat_M.resize(0, 4);
  EXPECT_FALSE(recheck().turns.judged());
}

}  // namespace
}  // namespace plumb::offline::recheck
