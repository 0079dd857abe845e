// SPDX-License-Identifier: Apache-2.0
#include "fit/calibrate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "arm/predicted_points.hpp"
#include "fit/fit.hpp"
#include "fit/fit_cell.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

SimulationPlan plan_with(double noise_m, std::uint64_t seed) {
  SimulationPlan plan;
  plan.poses = 200;
  plan.noise_m = noise_m;
  plan.seed = seed;
  plan.truth.geometry_m = 0.5e-3;
  plan.truth.geometry_rad = 0.5e-3;
  plan.truth.seed = seed;
  return plan;
}

std::vector<int> all_rows(const Measurements& m) {
  std::vector<int> rows(m.size());
  for (int i = 0; i < m.size(); ++i) rows[i] = i;
  return rows;
}

/// Largest distance between prediction and truth on poses that the fit never saw.
double fresh_error(const Cell& cell, SimulationPlan plan, const ArmState& state) {
  plan.seed += 1000;
  plan.poses = 500;
  const Simulation fresh = simulate(cell, plan);
  Rows3 error = fresh.true_p_M - predict_points(state, fresh.measured.q);
  return error.rowwise().norm().maxCoeff();
}

struct Shape {
  int joints;
  format::Convention convention;
  ArmKind kind;
};

class SyntheticArm : public ::testing::TestWithParam<Shape> {};

TEST_P(SyntheticArm, WithoutNoiseTheCalibratedArmIsTheTrueOneToANanometre) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto [joints, convention, kind] = GetParam();
    const Cell cell = random_cell(seed, joints, convention, kind);
    const SimulationPlan plan = plan_with(0.0, seed);
    const Simulation simulation = simulate(cell, plan);
    const Calibration c = calibrate(cell, simulation.measured, all_rows(simulation.measured));
    EXPECT_LT(fresh_error(cell, plan, c.state), 1e-9) << "seed " << seed << ", rank " << c.rank;
  }
}

TEST_P(SyntheticArm, WithNoiseTheTrueErrorIsFarBelowTheNoise) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto [joints, convention, kind] = GetParam();
    const Cell cell = random_cell(seed, joints, convention, kind);
    const SimulationPlan plan = plan_with(20e-6, seed);
    const Simulation simulation = simulate(cell, plan);
    const Calibration c = calibrate(cell, simulation.measured, all_rows(simulation.measured));
    EXPECT_LT(fresh_error(cell, plan, c.state), 40e-6) << "seed " << seed;
  }
}

TEST_P(SyntheticArm, CompleteLinkTwistsDescribeTheSameArm) {
  const auto [joints, convention, kind] = GetParam();
  Cell cell = random_cell(3, joints, convention, kind);
  cell.fit.model = FitSettings::Model::kComplete;
  const SimulationPlan plan = plan_with(0.0, 3);
  const Simulation simulation = simulate(cell, plan);
  const Calibration c = calibrate(cell, simulation.measured, all_rows(simulation.measured));
  EXPECT_LT(fresh_error(cell, plan, c.state), 1e-9);
}

constexpr auto kStandard = format::Convention::kStandard;
constexpr auto kModified = format::Convention::kModified;
INSTANTIATE_TEST_SUITE_P(Arms, SyntheticArm,
                         ::testing::Values(Shape{4, kStandard, ArmKind::kRevolute},
                                           Shape{5, kModified, ArmKind::kRevolute},
                                           Shape{6, kStandard, ArmKind::kRevolute},
                                           Shape{6, kModified, ArmKind::kRevolute},
                                           Shape{7, kStandard, ArmKind::kRevolute},
                                           Shape{7, kModified, ArmKind::kRevolute},
                                           Shape{4, kStandard, ArmKind::kScara},
                                           Shape{4, kModified, ArmKind::kScara}),
                         [](const auto& shape) {
                           const Shape& s = shape.param;
                           return std::string(s.kind == ArmKind::kScara ? "Scara" : "Revolute") +
                                  std::to_string(s.joints) +
                                  (s.convention == kStandard ? "Standard" : "Modified");
                         });

TEST(Calibrate, ASixJointArmSeenThroughOnePointHasTwentySevenNumbers) {
  const Cell cell = random_cell(1, 6, kStandard, ArmKind::kRevolute);
  const Simulation s = simulate(cell, plan_with(1e-5, 1));
  EXPECT_EQ(calibrate(cell, s.measured, all_rows(s.measured)).rank, 27);
}

TEST(Calibrate, MeasuredOrientationsAddTheTurnOfTheTargetAndAreMet) {
  Cell cell = random_cell(2, 6, kStandard, ArmKind::kRevolute);
  cell.measurement.sigma_rad = 20e-6;
  SimulationPlan plan = plan_with(0.0, 2);
  plan.noise_rad = 0.0;
  const Simulation s = simulate(cell, plan);
  const Calibration c = calibrate(cell, s.measured, all_rows(s.measured));
  EXPECT_EQ(c.rank, 30);
  EXPECT_LT(fresh_error(cell, plan, c.state), 1e-9);
  EXPECT_LT(turn_errors(c.state, s.measured).maxCoeff(), 1e-7);
}

TEST(Calibrate, HeldOutOrientationsShowTheNoiseOfTheReadings) {
  Cell cell = random_cell(2, 6, kStandard, ArmKind::kRevolute);
  cell.measurement.sigma_rad = 50e-6;
  SimulationPlan plan = plan_with(10e-6, 2);
  plan.poses = 400;
  plan.noise_rad = 50e-6;
  const Fit fit = fit_cell(cell, simulate(cell, plan).measured);
  EXPECT_EQ(fit.turn_held.n, fit.held.n);
  EXPECT_NEAR(fit.turn_held.rms, std::sqrt(3.0) * 50e-6, 15e-6);
  cell.measurement.sigma_rad = {};
  EXPECT_EQ(fit_cell(cell, simulate(cell, plan).measured).turn_held.n, 0);
}

TEST(Calibrate, AReadingWithALargeSigmaCountsForLittle) {
  const Cell cell = random_cell(4, 6, kStandard, ArmKind::kRevolute);
  SimulationPlan plan = plan_with(10e-6, 4);
  Simulation s = simulate(cell, plan);
  s.measured.sigma_m = Rows3::Constant(s.measured.size(), 3, 10e-6);
  for (int i = 0; i < s.measured.size(); i += 10) {
    s.measured.p_M(i, 0) += 2e-3;
    s.measured.sigma_m(i, 0) = 2e-3;
  }
  const Calibration c = calibrate(cell, s.measured, all_rows(s.measured));
  EXPECT_LT(fresh_error(cell, plan, c.state), 30e-6);
}

TEST(Calibrate, HeldOutErrorIsHonestAgainstTheNoiseFloorOnCleanData) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Cell cell = random_cell(seed, 6, kModified, ArmKind::kRevolute);
    const Simulation s = simulate(cell, plan_with(20e-6, seed));
    const Fit fit = fit_cell(cell, s.measured);
    EXPECT_NEAR(fit.held.mean / (1.596 * 20e-6), 1.1, 0.25) << "seed " << seed;
    EXPECT_LT(fit.held.mean, 0.2 * fit.nominal_held.mean);
  }
}

TEST(Calibrate, FewerCoordinatesThanParametersAreRefusedWithExitCodeFour) {
  const Cell cell = random_cell(1, 6, kStandard, ArmKind::kRevolute);
  SimulationPlan plan = plan_with(1e-5, 1);
  plan.poses = 2;
  const Simulation s = simulate(cell, plan);
  try {
    (void)calibrate(cell, s.measured, all_rows(s.measured));
    FAIL() << "two poses were accepted";
  } catch (const Failure& f) {
    EXPECT_EQ(f.exit_code(), Exit::kNumbersSayNo);
    EXPECT_EQ(f.problems().front().code, "E-FIT-FEW");
  }
}

TEST(Calibrate, WhereAnEffectIsTooMuchForThePosesItIsNamedAndNotThePosesBlamed) {
  Cell cell = random_cell(1, 6, kStandard, ArmKind::kRevolute);
  SimulationPlan plan = plan_with(1e-5, 1);
  plan.poses = 20;
  const Simulation s = simulate(cell, plan);
  EXPECT_NO_THROW((void)calibrate(cell, s.measured, all_rows(s.measured)));
  cell.effects.push_back(
      {.name = "joint_table", .joints = {0, 1, 2, 3}, .options = {}, .place = {}});
  try {
    (void)calibrate(cell, s.measured, all_rows(s.measured));
    FAIL() << "more parameters than coordinates were accepted";
  } catch (const Failure& f) {
    EXPECT_EQ(f.problems().front().code, "E-FIT-FEW");
    EXPECT_NE(f.problems().front().message.find("the 480 more parameters of joint_table"),
              std::string::npos)
        << f.problems().front().message;
  }
}

TEST(Calibrate, FixedParametersStayAtNominal) {
  Cell cell = random_cell(1, 6, kStandard, ArmKind::kRevolute);
  cell.fit.fixed = {"J2.a", "J3.alpha"};
  const Simulation s = simulate(cell, plan_with(1e-5, 1));
  const Calibration c = calibrate(cell, s.measured, all_rows(s.measured));
  const auto& joints = c.state.arm.calibrated.joints;
  EXPECT_EQ(joints[1].a, cell.nominal.joints[1].a);
  EXPECT_EQ(joints[2].alpha, cell.nominal.joints[2].alpha);
  for (const auto& e : c.estimates) EXPECT_NE(e.name, "J2.a");
}

}  // namespace
}  // namespace plumb::offline
