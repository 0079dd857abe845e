// SPDX-License-Identifier: Apache-2.0
#include "fit/verdict.hpp"

#include <gtest/gtest.h>

#include "arm/predicted_points.hpp"
#include "fit/fit_cell.hpp"
#include "noise/repeatability.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

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

Outlier standing_out(const char* pose, double error_m) {
  return {.row = 0, .error_m = error_m, .times = 50.0, .pose = pose};
}

TEST(Verdict, ReadingsThatStandOutAreNamedBesideTheHeadlineAndDoNotRuleIt) {
  Fit fit = fit_with(stats(0.236e-3, 3e-3, 5.1e-3), 16e-6);
  fit.held_without_outliers = stats(17e-6, 30e-6, 40e-6);
  fit.held_without_outliers.n = 47;
  fit.held_outliers = {standing_out("P7", 5.1e-3), standing_out("P24", 3e-3),
                       standing_out("P41", 3.5e-3)};
  EXPECT_EQ(verdict_head(fit, kTolerance_m), "Good but for P7, P24, P41");
  EXPECT_EQ(grade(fit, kTolerance_m), Grade::kPartly);
  const std::string text = verdict(fit, kTolerance_m);
  EXPECT_NE(text.find("0.017 mm mean"), std::string::npos) << text;
  EXPECT_NE(text.find("of 47 readings (without P7, P24, P41, which miss by 3.000 to 5.100 mm)"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("nothing more can be learnt"), std::string::npos) << text;
  EXPECT_TRUE(next_step(fit, kTolerance_m).starts_with("check"));
  fit.held_outliers.resize(1);
  fit.held_without_outliers.n = 49;
  EXPECT_EQ(verdict_head(fit, kTolerance_m), "Good but for P7");
  // One that stands out and yet keeps the tolerance is no reason to say so.
  fit.held = stats(17e-6, 30e-6, 90e-6);
  EXPECT_EQ(grade(fit, kTolerance_m), Grade::kGood);
  EXPECT_EQ(verdict_head(fit, kTolerance_m), "Good");
}

TEST(Verdict, SoManyReadingsThatStandOutAreNoSingleBadOnes) {
  Fit fit = fit_with(stats(1e-3, 3e-3, 5.1e-3), 16e-6);
  fit.held_without_outliers = stats(17e-6, 30e-6, 40e-6);
  fit.held_without_outliers.n = 40;
  fit.held_outliers.assign(10, standing_out("P7", 5.1e-3));
  EXPECT_EQ(grade(fit, kTolerance_m), Grade::kBad);
  EXPECT_NE(verdict(fit, kTolerance_m).find("10 of them stand out, too many"), std::string::npos)
      << verdict(fit, kTolerance_m);
}

/// A healthy arm, and so many of its readings spoilt by 3 to 5 mm.
Fit spoilt(std::uint64_t seed, int bad) {
  const Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = 240;
  plan.repeats = 3;
  plan.noise_m = 8e-6;
  plan.seed = plan.truth.seed.emplace(seed);
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
  Measurements measured = simulate(cell, plan).measured;
  const int every = measured.size() / bad;
  for (int k = 0; k < bad; ++k)
    measured.p_M(every * k + every / 2, (k + static_cast<int>(seed)) % 3) +=
        3e-3 + 2e-3 * static_cast<double>(k) / bad;
  return fit_cell(cell, measured);
}

TEST(Verdict, BadReadingsAmongThoseOfAHealthyArmAreNamedAndBlameNothingElse) {
  for (const int bad : {1, 14, 28})  // of 288: single ones, 5 % and 10 %
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Fit fit = spoilt(seed, bad);
      const std::string text = verdict(fit, kTolerance_m);
      EXPECT_TRUE(text.starts_with("Good but for "))
          << bad << " bad, seed " << seed << ": " << text;
      EXPECT_EQ(grade(fit, kTolerance_m), Grade::kPartly);
      EXPECT_EQ(static_cast<int>(fit.held_outliers.size()), bad) << text;
      EXPECT_LT(usual_held(fit).p95, 40e-6) << text;
    }
}

TEST(Verdict, WhatIsOnlyInferredDoesNotMoveTheFloorAndSaysWhatToMeasure) {
  for (const auto source : {NoiseFloor::Source::kRepeats, NoiseFloor::Source::kSigma}) {
    Fit fit = fit_with(stats(72e-6, 150e-6, 200e-6), 24e-6);
    fit.floor.source = source;
    Repeatability scatter;
    scatter.nats = 20.0;
    scatter.sigma_m = 3.0 * fit.floor.sigma_m;
    scatter.usual_sigma_m = 1.0;
    const NoiseFloor with = with_repeatability(fit.floor, scatter);
    EXPECT_EQ(with.sigma_m, fit.floor.sigma_m);
    EXPECT_EQ(with.mean_m, fit.floor.mean_m);
    EXPECT_NEAR(with.inferred_m, 72e-6, 1e-9);
    fit.floor = with;
    EXPECT_EQ(verdict_head(fit, kTolerance_m), "Perhaps limited by the arm");
    for (const double tolerance_m : {100e-6, 1e-3}) {
      const std::string text = verdict(fit, tolerance_m);
      EXPECT_NE(text.find("noise floor 0.024 mm"), std::string::npos) << text;
      EXPECT_NE(text.find("inferred from what the model leaves"), std::string::npos) << text;
      EXPECT_NE(text.find("repeat some poses"), std::string::npos) << text;
      EXPECT_EQ(text.find("which no model removes"), std::string::npos) << text;
    }
    EXPECT_EQ(grade(fit, 1e-3), Grade::kGood);
  }
}

TEST(Verdict, AtAStatedFloorNobodyIsToldThatNothingCanBeLearnt) {
  Fit fit = fit_with(stats(16e-6, 30e-6, 40e-6), 16e-6);
  fit.floor.source = NoiseFloor::Source::kSigma;
  const std::string text = verdict(fit, kTolerance_m);
  EXPECT_EQ(grade(fit, kTolerance_m), Grade::kGood);
  EXPECT_EQ(text.find("nothing more can be learnt"), std::string::npos) << text;
  EXPECT_NE(text.find("of the stated sigma"), std::string::npos) << text;
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

TEST(Verdict, AnArmWhoseSizeNothingTellsIsGoodInItsShapeOnly) {
  Fit fit = fit_with(stats(16e-6, 30e-6, 40e-6), 16e-6);
  fit.size_unknown = true;
  EXPECT_EQ(beginning(fit), "Good in shape, of unknown size");
  EXPECT_EQ(grade(fit, kTolerance_m), Grade::kPartly);
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
