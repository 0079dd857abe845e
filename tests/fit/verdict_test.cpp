// SPDX-License-Identifier: Apache-2.0
#include "fit/verdict.hpp"

#include <gtest/gtest.h>

#include "simulate/simulate.hpp"

namespace plumb::offline {
namespace {

constexpr double kTolerance_m = 100e-6;

ErrorStats stats(double mean, double p95, double max) {
  return {.n = 50, .mean = mean, .rms = mean, .p95 = p95, .max = max};
}

Fit fit_with(const ErrorStats& held, double floor_m) {
  Fit out;
  out.held = out.held_without_outliers = held;
  out.floor = {.sigma_m = floor_m / 1.596,
               .mean_m = floor_m,
               .rms_m = floor_m,
               .dof = 60,
               .source = NoiseFloor::Source::kRepeats};
  return out;
}

std::string beginning(const Fit& fit) {
  const std::string text = verdict(fit, kTolerance_m);
  return text.substr(0, text.find(':'));
}

TEST(Verdict, GoodIsWithinToleranceAndAtTheFloor) {
  const Fit fit = fit_with(stats(16e-6, 30e-6, 40e-6), 16e-6);
  EXPECT_EQ(beginning(fit), "Good");
  EXPECT_NE(verdict(fit, kTolerance_m).find("nothing more can be learnt"), std::string::npos);
}

TEST(Verdict, OnePoseFarBeyondToleranceIsNotGood) {
  Fit fit = fit_with(stats(1e-3, 30e-6, 50e-3), 16e-6);
  fit.held_without_outliers = stats(16e-6, 30e-6, 40e-6);
  EXPECT_EQ(beginning(fit), "Not good everywhere");
  EXPECT_FALSE(keeps(fit.held, kTolerance_m));
}

TEST(Verdict, RepeatsThatDifferByMoreThanTheModelMissesAreNoNoiseFloor) {
  Fit fit = fit_with(stats(39e-6, 70e-6, 80e-6), 68e-6);
  EXPECT_EQ(quality(fit, kTolerance_m), Quality::kRepeatsDisagree);
  const std::string text = verdict(fit, kTolerance_m);
  EXPECT_EQ(text.find("nothing more can be learnt"), std::string::npos) << text;
  EXPECT_NE(text.find("repeats of a pose differ by more than the model misses"), std::string::npos);
  EXPECT_TRUE(next_step(fit, kTolerance_m).starts_with("diagnose"));
  fit.floor.source = NoiseFloor::Source::kSigma;
  EXPECT_NE(verdict(fit, kTolerance_m).find("sigma is stated too large"), std::string::npos);
}

TEST(Verdict, ASigmaStatedTooLargeIsNotBlamedOnTheTracker) {
  Fit fit = fit_with(stats(196e-6, 300e-6, 290e-6), 500e-6);
  fit.floor.source = NoiseFloor::Source::kSigma;
  EXPECT_EQ(quality(fit, kTolerance_m), Quality::kBeyondSigmaTooLarge);
  EXPECT_EQ(beginning(fit), "Not good enough");
  EXPECT_NE(verdict(fit, kTolerance_m).find("Correct sigma_um"), std::string::npos);
  EXPECT_NE(next_step(fit, kTolerance_m).find("sigma_um"), std::string::npos);
}

TEST(Verdict, AtANoiseFloorBeyondToleranceTheReadingsOrSomethingThatMovedAreToBlame) {
  const Fit fit = fit_with(stats(196e-6, 300e-6, 400e-6), 196e-6);
  EXPECT_EQ(beginning(fit), "Limited by the measurement");
  EXPECT_NE(verdict(fit, kTolerance_m).find("something moved between them"), std::string::npos);
  EXPECT_TRUE(next_step(fit, kTolerance_m).starts_with("compare"));
}

TEST(Verdict, JointsThatNeverMovedAreNamed) {
  Fit fit = fit_with(stats(16e-6, 30e-6, 40e-6), 16e-6);
  fit.still = {"J2"};
  EXPECT_EQ(beginning(fit), "Good only while J2 stays where it was");
  fit.still = {"J2", "J3"};
  EXPECT_EQ(beginning(fit), "Good only while J2, J3 stay where they were");
}

TEST(Verdict, WhatFewPosesLeaveIsNotCalledMissingPhysics) {
  Fit fit = fit_with(stats(32e-6, 60e-6, 80e-6), 16e-6);
  EXPECT_NE(verdict(fit, kTolerance_m).find("physical"), std::string::npos);
  fit.unavoidable_ratio = 2.0;
  EXPECT_EQ(verdict(fit, kTolerance_m).find("physical"), std::string::npos);
}

TEST(Verdict, AnArmThatIsRightIsNeverSaidToLackPhysicsHoweverFewThePoses) {
  const Cell cell = random_cell(5, 6, format::Convention::kStandard, ArmKind::kRevolute);
  for (const int poses : {16, 20, 25, 30, 40})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SimulationPlan plan;
      plan.poses = poses;
      plan.noise_m = 10e-6;
      plan.seed = seed;
      plan.truth.seed = seed;
      plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
      Cell stated = cell;
      stated.measurement.sigma_m = 10e-6;
      const Fit fit = fit_cell(stated, simulate(cell, plan).measured);
      EXPECT_EQ(verdict(fit, kTolerance_m).find("physical"), std::string::npos)
          << poses << " poses, seed " << seed << ": " << verdict(fit, kTolerance_m);
    }
}

TEST(FitCell, NamesJointsThatStandStill) {
  const Cell cell = random_cell(5, 6, format::Convention::kStandard, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = 100;
  plan.seed = 1;
  plan.truth.seed = 1;
  Measurements m = simulate(cell, plan).measured;
  EXPECT_TRUE(fit_cell(cell, m).still.empty());
  m.q.col(5).setConstant(0.3);
  ArmState nominal;
  nominal.arm.calibrated = cell.nominal;
  nominal.X_TG.p = {0.05, 0.0, 0.1};
  m.p_M = predict_points(nominal, m.q);
  EXPECT_EQ(fit_cell(cell, m).still, std::vector<std::string>{cell.nominal.joints[5].name});
}

}  // namespace
}  // namespace plumb::offline
