// SPDX-License-Identifier: Apache-2.0
#include "check/moved_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "arm/predicted_points.hpp"
#include "check/check.hpp"
#include "noise/main_jump.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/check/simulated_arm.hpp"
#include "tests/random_numbers.hpp"

/// What moved once while the arm was measured, and what only looks like it.
namespace plumb::offline {
namespace {

constexpr int kPoses = 90;

struct Case {
  Cell cell;
  MeasurementFiles measured;
};

Case measured_with(std::uint64_t seed, const std::vector<std::string>& effects) {
  Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = kPoses;
  plan.seed = seed;
  plan.noise_m = 20e-6;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.3e-3;
  plan.truth.effects = effects;
  MeasurementFiles measured = simulate(cell, plan).measured;
  return {std::move(cell), std::move(measured)};
}

const Problem* moved(const Check& check) {
  for (const auto& problem : check.findings)
    if (problem.code == "W-CHECK-MOVED") return &problem;
  return nullptr;
}

void expect_named(const std::string& effect, const std::string& who, const std::string& remedy) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Case at = measured_with(seed, {effect});
    const Check check = check_cell(at.cell, at.measured);
    const Problem* problem = moved(check);
    ASSERT_NE(problem, nullptr) << effect << " " << seed << " " << verdict(check);
    EXPECT_EQ(problem->severity, Severity::kWarning);
    EXPECT_NE(problem->message.find(who + " moved by some"), std::string::npos) << problem->message;
    EXPECT_NE(problem->help.find(remedy), std::string::npos) << problem->help;
    EXPECT_NE(problem->help.find("plumb compare"), std::string::npos) << problem->help;
    EXPECT_EQ(verdict(check).find("Usable: "), std::string::npos) << verdict(check);
    EXPECT_NE(verdict(check).find(who), std::string::npos) << verdict(check);
  }
}

TEST(MovedPart, ATrackerPushedByFifteenMillimetresIsNamed) {
  expect_named("step_base=15mm", "the tracker or the base", "--set of=base");
}

TEST(MovedPart, AReflectorSeatedAnewIsNamed) {
  expect_named("step_reflector=5mm", "the reflector or the tool", "--set of=tool");
}

TEST(MovedPart, AnEncoderThatSlippedIsNamed) {
  expect_named("step_encoder:J3=3mrad", "the zero of J3", "step --joints J3 ");
}

TEST(MovedPart, AJumpSoLargeThatNoReadingFitsIsTheReasonGiven) {
  for (long seed = 1; seed <= tests::scaled(1); ++seed) {
    const Case at = measured_with(static_cast<std::uint64_t>(seed), {"step_base=150mm"});
    const Check check = check_cell(at.cell, at.measured);
    ASSERT_NE(moved(check), nullptr) << seed << " " << verdict(check);
    EXPECT_NE(verdict(check).find("the tracker or the base moved by some "), std::string::npos)
        << verdict(check);
    EXPECT_EQ(verdict(check).find("e+"), std::string::npos) << verdict(check);
  }
}

/// `count` poses in which the reflector is nearest to the axis of J1, and as many of all poses.
RowsN near_the_axis_then_anywhere(const Cell& cell, const ArmState& arm, int count) {
  std::mt19937_64 random(5);
  RowsN all(30000, cell.joints());
  for (int j = 0; j < cell.joints(); ++j) {
    const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
    std::uniform_real_distribution<double> between(row.q_min, row.q_max);
    for (Eigen::Index i = 0; i < all.rows(); ++i) all(i, j) = between(random);
  }
  const Eigen::VectorXd lever = predict_points(arm, all).leftCols<2>().rowwise().norm();
  std::vector<int> rows(static_cast<std::size_t>(all.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  std::sort(rows.begin(), rows.end(), [&](int a, int b) { return lever(a) < lever(b); });
  rows.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) rows.push_back(i);
  return all(rows, Eigen::all);
}

TEST(MovedPart, AJumpThatWouldExplainMoreThanThereIsIsNone) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
    ArmState arm;
    arm.arm.calibrated = cell.nominal;
    arm.X_TG.p = {0.03, -0.02, 0.1};
    SimulationPlan plan;
    plan.seed = seed;
    plan.q = near_the_axis_then_anywhere(cell, arm, kPoses / 2);
    plan.poses = static_cast<int>(plan.q.rows());
    plan.noise_m = 10e-6;
    plan.truth.X_MB = format::Pose{};
    plan.truth.target_T = {0.03, -0.02, 0.1};
    Measurements measured = simulate(cell, plan).measured;
    // As if J1 had been turned, where that moves the reflector by some tenths of a millimetre. It
    // would move the other points by centimetres, of which nothing is seen.
    for (int i = 0; i < kPoses / 2; ++i) {
      const auto p = measured.p_M.row(i);
      measured.p_M.row(i) += 0.05 * Eigen::RowVector3d(-p(1), p(0), 0.0);
    }
    std::vector<int> rows(static_cast<std::size_t>(measured.size()));
    std::iota(rows.begin(), rows.end(), 0);
    const Rows3 error = residuals(measured, predict_points(arm, measured));
    EXPECT_LT(error.rowwise().norm().maxCoeff(), 5e-3);
    const auto jump = main_jump(arm, measured, rows);
    EXPECT_TRUE(!jump || jump->size_m < 5e-3) << seed << " " << (jump ? jump->size_m : 0.0);
  }
}

TEST(MovedPart, AStepInTheModelIsNoDoubt) {
  Case at = measured_with(2, {"step_base=15mm"});
  EffectEntry step{.name = "step", .joints = {}, .options = {}, .place = {}};
  step.options["of"] = std::string("base");
  step.options["after_row"] = static_cast<double>(kPoses / 2);
  at.cell.effects.push_back(step);
  const Check check = check_cell(at.cell, at.measured);
  EXPECT_EQ(moved(check), nullptr);
  EXPECT_EQ(verdict(check).rfind("Usable: ", 0), 0U) << verdict(check);
}

TEST(MovedPart, NothingOfTheKindIsSaidOfSoundArmsDriftWarmingUpAndOtherEffects) {
  const std::vector<std::vector<std::string>> lacking = {
      {},
      {"drift=500um"},
      {"thermal_growth::10"},
      {"gear_harmonics:J2=1mrad,J3=1mrad"},
      {"gear_ripple:J2:20@cycles=20"},
      {"joint_compliance:J2=2mrad,J3=2mrad"},
      {"reversal:J2,J3:10"},
      {"drift=300um", "gear_harmonics:J1=1mrad"},
      {"joint_compliance:J2=1mrad", "thermal_growth::5"}};
  for (const auto& effects : lacking)
    for (long seed = 1; seed <= tests::scaled(3); ++seed) {
      const Case at = measured_with(static_cast<std::uint64_t>(seed), effects);
      const Check check = check_cell(at.cell, at.measured);
      const Problem* problem = moved(check);
      EXPECT_EQ(problem, nullptr) << seed << (effects.empty() ? "" : effects[0]) << ": "
                                  << (problem ? problem->message : "");
    }
}

/// Light first, then heavy, with no time to tell that it was otherwise.
MeasurementFiles by_payload(const MeasurementFiles& measured) {
  std::vector<int> rows;
  for (int i = 0; i < measured.size(); ++i) rows.push_back(i);
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) {
    return measured.context.payload(a, 0) < measured.context.payload(b, 0);
  });
  MeasurementFiles out = pick(measured, rows);
  out.context.time_s.resize(0);
  for (int i = 0; i < out.size(); ++i) out.context.order(i) = i;
  return out;
}

TEST(MovedPart, AnArmThatYieldsUnderAnotherPayloadFromHalfWayOnDidNotMove) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
    SimulationPlan plan;
    plan.poses = kPoses;
    plan.seed = seed;
    plan.choice.range = 0.5;
    plan.payloads = {Payload{0.0, {0.0, 0.0, 0.1}}, Payload{30.0, {0.0, 0.0, 0.1}}};
    plan.truth.geometry_m = plan.truth.geometry_rad = 0.3e-3;
    plan.truth.effects = {seed % 2 == 0 ? "payload_compliance" : "base_compliance"};
    const MeasurementFiles measured = by_payload(simulate(cell, plan).measured);
    const Check check = check_cell(cell, measured);
    const Problem* problem = moved(check);
    EXPECT_EQ(problem, nullptr) << seed << ": " << (problem ? problem->message : "");
  }
}

/// A tracker that was pushed by `shift_M` before the row `first`.
SimulatedArm pushed(std::uint64_t seed, int first, const Eigen::RowVector3d& shift_M) {
  SimulatedArm out = simulated_arm(seed, kPoses);
  for (int i = first; i < out.measured.size(); ++i) out.measured.p_M.row(i) += shift_M;
  return out;
}

std::optional<MovedPart> moved_in(const SimulatedArm& at) {
  return moved_part(at.cell, at.measured, at.rows, place_nominal(at.cell, at.measured, at.rows));
}

TEST(MovedPart, IsPlacedBetweenTheLinesWhereItMoved) {
  const Eigen::RowVector3d shift(9e-3, -12e-3, 8e-3);
  for (const int first : {20, 45, 70}) {
    const SimulatedArm at = pushed(4, first, shift);
    const auto found = moved_in(at);
    ASSERT_TRUE(found) << first;
    const auto& lines = at.measured.tables.front().lines;
    const auto line = [&](int row) { return std::to_string(lines[static_cast<std::size_t>(row)]); };
    EXPECT_TRUE(holds(found->words, "between lines " + line(first - 1) + " and " + line(first)))
        << found->words;
    EXPECT_TRUE(holds(found->finding.message, found->words)) << found->finding.message;
    EXPECT_TRUE(holds(found->finding.help, "--set after_row=" + std::to_string(first) + " "))
        << found->finding.help;
    ASSERT_TRUE(found->finding.place);
    EXPECT_EQ(found->finding.place->line, lines[static_cast<std::size_t>(first)]);
    const std::string before = "moved by some ";
    const auto size = found->words.find(before);
    ASSERT_NE(size, std::string::npos) << found->words;
    EXPECT_NEAR(std::atof(found->words.c_str() + size + before.size()), 1e3 * shift.norm(),
                0.1 * 1e3 * shift.norm())
        << found->words;
  }
}

TEST(MovedPart, OfReadingsThatStandInNoFileIsPlacedByTheirNumbers) {
  SimulatedArm at = pushed(4, 45, {9e-3, -12e-3, 8e-3});
  at.measured.tables.clear();
  const auto found = moved_in(at);
  ASSERT_TRUE(found);
  EXPECT_TRUE(holds(found->words, "between rows 45 and 46")) << found->words;
  EXPECT_FALSE(found->finding.place);
}

TEST(MovedPart, IsNoneWhereNothingMovedOrEachReadingIsOffByItself) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SimulatedArm at = pushed(seed, 45, Eigen::RowVector3d::Zero());
    EXPECT_FALSE(moved_in(at)) << seed;
    tests::Random random(seed);
    for (double& x : at.measured.p_M.reshaped()) x += random.uniform(-5e-3, 5e-3);
    EXPECT_FALSE(moved_in(at)) << seed;
  }
}

}  // namespace
}  // namespace plumb::offline
