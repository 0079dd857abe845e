// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "check/check.hpp"
#include "fit/fit.hpp"
#include "fit/fit_cell.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

/// What fit fits well, check calls usable; and each reason that it gives is the true one.
namespace plumb::offline {
namespace {

constexpr double kWell_m = 60e-6;  // of noise of 10 um an axis
constexpr double kTurn = 2.0 * M_PI;

Cell arm_of(std::uint64_t seed, int joints) {
  Cell cell =
      random_cell(seed, std::max(joints, 4), format::Convention::kStandard, ArmKind::kRevolute);
  const auto count = static_cast<std::size_t>(joints);
  cell.nominal.joints.resize(count);
  if (cell.mechanics.size() > count) cell.mechanics.resize(count);
  if (cell.assumed_limits.size() > count) cell.assumed_limits.resize(count);
  cell.text = write_cell(cell);
  return cell;
}

SimulationPlan plan_of(std::uint64_t seed) {
  SimulationPlan plan;
  plan.poses = 80;
  plan.repeats = 3;
  plan.seed = seed;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.3e-3;
  return plan;
}

const Problem* found(const Check& check, const std::string& code) {
  for (const auto& problem : check.findings)
    if (problem.code == code) return &problem;
  return nullptr;
}

std::string said(const Check& check) {
  std::string out;
  for (const auto& problem : check.findings)
    if (problem.severity != Severity::kNote) out += problem.code + " " + problem.message + "\n";
  return out;
}

Check expect_usable_as_fit_does(const Cell& cell, const MeasurementFiles& measured,
                                const std::string& name) {
  const Fit fit = fit_cell(cell, measured);
  EXPECT_LT(fit.held.rms, kWell_m) << name;
  Check check = check_cell(cell, measured);
  EXPECT_EQ(check.exit, Exit::kDone) << name << "\n" << said(check);
  EXPECT_EQ(verdict(check).rfind("Usable: ", 0), 0U) << name << ": " << verdict(check);
  return check;
}

TEST(CheckAsFit, ArmsOfOneAndTwoJointsAreUsable) {
  for (const int joints : {1, 2, 3})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Cell cell = arm_of(seed, joints);
      const auto name = std::to_string(joints) + " joints, seed " + std::to_string(seed);
      const Check check =
          expect_usable_as_fit_does(cell, simulate(cell, plan_of(seed)).measured, name);
      EXPECT_EQ(found(check, "E-CHECK-EQUAL"), nullptr) << name;
      EXPECT_EQ(found(check, "W-CHECK-NOTHING") != nullptr, joints == 1) << name;
      EXPECT_EQ(verdict(check).find("to 0 mm"), std::string::npos) << verdict(check);
    }
}

TEST(CheckAsFit, WholeTurnsBeyondTheLimitsAreAWarning) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Cell cell = arm_of(seed, 6);
    const MeasurementFiles measured = simulate(cell, plan_of(seed)).measured;
    MeasurementFiles all = measured, some = measured;
    for (Eigen::Index i = 0; i < measured.q.rows(); ++i) {
      all.q(i, 5) += kTurn;
      if (measured.q(i, 5) < 0.0) some.q(i, 5) += kTurn;
    }
    for (const auto* turned : {&all, &some}) {
      const Check check = expect_usable_as_fit_does(cell, *turned, "J6 turned");
      const Problem* warning = found(check, "W-CHECK-LIMITS");
      ASSERT_NE(warning, nullptr);
      EXPECT_EQ(warning->severity, Severity::kWarning);
      EXPECT_NE(warning->message.find("J6 is beyond"), std::string::npos) << warning->message;
      EXPECT_NE(warning->message.find("a whole turn"), std::string::npos) << warning->message;
    }
  }
}

TEST(CheckAsFit, ALengthOfFortyMillimetresOffIsSaidAndFitted) {
  for (long n = 1; n <= tests::scaled(1); ++n) {
    const auto seed = static_cast<std::uint64_t>(n);
    Cell cell = arm_of(seed, 6);
    const MeasurementFiles measured = simulate(cell, plan_of(seed)).measured;
    cell.nominal.joints[2].d += 40e-3;
    cell.text = write_cell(cell);
    const Check check =
        expect_usable_as_fit_does(cell, measured, "40 mm, seed " + std::to_string(seed));
    EXPECT_EQ(found(check, "E-CHECK-NOFIT"), nullptr) << said(check);
    EXPECT_LT(check.detection.best.fitted_m, 0.2e-3);
  }
}

/// Of so few lengths one is nearly a factor on all points, but not a unit.
TEST(CheckAsFit, ALengthThatIsOffIsNoFactorOnAllPoints) {
  Cell cell = arm_of(1, 2);
  for (auto& row : cell.nominal.joints) {
    format::JointRow plain;
    plain.name = row.name;
    plain.q_min = -2.0;
    plain.q_max = 2.0;
    row = plain;
  }
  cell.nominal.joints[0].a = 0.4;
  cell.nominal.joints[1].a = 0.3;
  cell.text = write_cell(cell);
  const MeasurementFiles measured = simulate(cell, plan_of(1)).measured;
  cell.nominal.joints[0].a -= 40e-3;
  cell.text = write_cell(cell);
  const Check check = expect_usable_as_fit_does(cell, measured, "J1.a 40 mm off");
  EXPECT_EQ(found(check, "W-CHECK-SCALE"), nullptr) << said(check);
}

TEST(CheckAsFit, JointColumnsThatStoodStillWhileTheArmMovedAreNotCalledOnePose) {
  const Cell cell = arm_of(1, 6);
  MeasurementFiles measured = simulate(cell, plan_of(1)).measured;
  MeasurementFiles small = measured;
  measured.q.rowwise() = measured.q.row(0).eval();
  const Check still = check_cell(cell, measured);
  const Problem* equal = found(still, "E-CHECK-EQUAL");
  ASSERT_NE(equal, nullptr);
  EXPECT_NE(equal->message.find("not the joint positions of these points"), std::string::npos)
      << equal->message;
  small.q *= 0.5e-3;
  try {
    fit_cell(cell, small);
    FAIL() << "fitted";
  } catch (const Failure& failure) {
    const Problem& problem = failure.problems().front();
    EXPECT_EQ(problem.code, "E-FIT-ONE-POSE");
    EXPECT_NE(problem.message.find("in another unit"), std::string::npos) << problem.message;
    EXPECT_EQ(problem.message.find("nearly all one pose"), std::string::npos) << problem.message;
  }
}

TEST(CheckAsFit, OneReadingIsTooFewAndNotManyOfOnePose) {
  const Cell cell = arm_of(1, 6);
  const Check check = check_cell(cell, pick(simulate(cell, plan_of(1)).measured, {0}));
  EXPECT_NE(check.exit, Exit::kDone);
  EXPECT_EQ(found(check, "E-CHECK-EQUAL"), nullptr) << said(check);
}

}  // namespace
}  // namespace plumb::offline
