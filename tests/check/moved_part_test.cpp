// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

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
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Case at = measured_with(seed, {"step_base=150mm"});
    const Check check = check_cell(at.cell, at.measured);
    ASSERT_NE(moved(check), nullptr) << seed << " " << verdict(check);
    EXPECT_NE(verdict(check).find("the tracker or the base moved by some "), std::string::npos)
        << verdict(check);
    EXPECT_EQ(verdict(check).find("e+"), std::string::npos) << verdict(check);
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
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Case at = measured_with(seed, effects);
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

}  // namespace
}  // namespace plumb::offline
