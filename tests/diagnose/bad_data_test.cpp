// SPDX-License-Identifier: Apache-2.0
// Data that cannot show an effect, or that mislead: a clear answer, never a wrong verdict.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "diagnose/diagnosis.hpp"
#include "fit/fit_cell.hpp"
#include "fit/verdict.hpp"
#include "simulate/planar.hpp"
#include "tests/cases/blind_case.hpp"

namespace plumb::offline {
namespace {

Diagnosis diagnosed(const BlindRequest& request, bool apply = true) {
  const BlindCase blind = make_blind_case(request);
  return diagnose(blind.cell, blind.measured.measured, {.apply = apply, .tell = {}});
}

bool not_testable(const Diagnosis& d, const std::string& effect) {
  return std::any_of(d.not_testable.begin(), d.not_testable.end(),
                     [&](const Testable& t) { return t.effect == effect; });
}

bool added(const Diagnosis& d, const std::string& effect) {
  return std::any_of(d.added.begin(), d.added.end(),
                     [&](const Addition& a) { return a.entry.name == effect; });
}

TEST(DiagnoseBadData, AConstantTemperatureIsNotTestableAndNeverAbsent) {
  BlindRequest request;
  request.climate = SimulationPlan::Climate::kConstant;
  const Diagnosis d = diagnosed(request);
  EXPECT_TRUE(not_testable(d, "thermal_growth"));
  EXPECT_EQ(d.finding, Finding::kComplete);
}

TEST(DiagnoseBadData, OnePayloadCannotShowWhatOnlyThePayloadDoes) {
  BlindRequest request;
  request.payloads = BlindRequest::Payloads::kConstant;
  request.effects = {"gear_harmonics:J3:4"};
  const Diagnosis d = diagnosed(request);
  EXPECT_TRUE(not_testable(d, "payload_compliance"));
  EXPECT_TRUE(added(d, "gear_harmonics"));
}

TEST(DiagnoseBadData, WithoutDirectionsReversalIsNotTestableAndNothingElseIsBlamed) {
  BlindRequest request;
  request.directions = Recorded::kNever;
  request.effects = {"reversal:J2:5"};
  const Diagnosis d = diagnosed(request);
  EXPECT_TRUE(not_testable(d, "reversal"));
  for (const auto& a : d.added)
    EXPECT_TRUE(a.entry.name == "settling_lag") << "blamed: " << a.entry.name;
}

TEST(DiagnoseBadData, GrossOutliersAreListedAndChangeNoVerdict) {
  BlindRequest request;
  request.outlier_share = 0.02;
  request.poses = 300;
  request.effects = {"joint_compliance:J2:5"};
  const Diagnosis d = diagnosed(request);
  request.outlier_share = 0.0;
  const Diagnosis clean = diagnosed(request, false);
  EXPECT_EQ(d.finding, Finding::kMissing);
  EXPECT_EQ(d.candidates.front().entry.name, "joint_compliance");
  EXPECT_EQ(d.candidates.front().entry.joints, clean.candidates.front().entry.joints);
  EXPECT_NEAR(d.candidates.front().ln_bayes, clean.candidates.front().ln_bayes,
              0.05 * clean.candidates.front().ln_bayes);
  EXPECT_NEAR(d.floor.mean_m, clean.floor.mean_m, 0.1 * clean.floor.mean_m);
  EXPECT_FALSE(d.outliers.empty());
  EXPECT_LE(d.added.size(), 2U);
}

TEST(DiagnoseBadData, SingleBadReadingsRuleNoFigureAndRefuseNoEffect) {
  BlindRequest request;
  request.outlier_share = 0.05;
  request.poses = 57;  // so few that the choice is made anew without each fold
  request.effects = {"reversal:J2:5"};
  const BlindCase blind = make_blind_case(request);
  const MeasurementFiles& measured = blind.measured.measured;
  const Fit fit = fit_cell(blind.cell, measured);
  ASSERT_FALSE(fit.held_outliers.empty());
  ASSERT_GT(fit.held.mean, 1.5 * usual_held(fit).mean);
  const Diagnosis d = diagnose(blind.cell, measured, {.apply = true, .tell = {}});
  EXPECT_NEAR(d.before.mean, usual_held(fit).mean, 0.01 * usual_held(fit).mean);
  EXPECT_EQ(d.finding, Finding::kMissing) << d.text;
  EXPECT_TRUE(added(d, "reversal")) << d.text_after;
  EXPECT_LT(d.after.mean, d.before.mean);
}

TEST(DiagnoseBadData, PosesOnAGridDoNotTurnARippleIntoSomethingElse) {
  BlindRequest request;
  request.poses = 500;
  request.choice.grid_levels = 9;
  request.effects = {"gear_ripple:J3:5@cycles=12"};
  const Diagnosis d = diagnosed(request);
  EXPECT_EQ(d.finding, Finding::kMissing);
  // On a grid waves alias: the joint is right, whatever the name of the wave.
  EXPECT_EQ(d.candidates.front().entry.joints, std::vector<int>{2});
}

TEST(DiagnoseBadData, FortyFivePosesAndHundredsOfCandidatesNameNothingWhereNothingIs) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    BlindRequest request;
    request.poses = 45;
    request.seed = seed;
    request.arm = seed % 2 == 0 ? BlindArm::kHeavy : BlindArm::kLight;
    named += diagnosed(request, false).finding != Finding::kComplete;
  }
  EXPECT_LE(named, 1);
}

TEST(DiagnoseBadData, AllRowsRepeatOnePoseIsRefusedInWords) {
  BlindRequest request;
  request.poses = 40;
  BlindCase blind = make_blind_case(request);
  auto& m = blind.measured.measured;
  for (int i = 1; i < m.size(); ++i) {
    m.q.row(i) = m.q.row(0);
    m.replicate_group[static_cast<std::size_t>(i)] = 0;
  }
  m.replicate_group[0] = 0;
  EXPECT_THROW(diagnose(blind.cell, m, {}), Failure);
}

TEST(DiagnoseBadData, WithoutANoiseFloorNothingFoundIsUndecidable) {
  BlindRequest request;
  request.repeats = 1;
  BlindCase blind = make_blind_case(request);
  blind.cell.measurement.sigma_m.reset();
  const Diagnosis d = diagnose(blind.cell, blind.measured.measured, {});
  EXPECT_EQ(d.finding, Finding::kUndecidable);
  EXPECT_NE(d.text.find("noise floor"), std::string::npos);
}

TEST(DiagnoseBadData, APlanarArmNamesItsBeamsAndWhatIsWrongWithThePublishedOne) {
  BlindRequest request;
  request.arm = BlindArm::kPlanarPrinted;
  request.poses = 400;
  const Diagnosis printed = diagnosed(request);
  EXPECT_EQ(printed.candidates.front().entry.name, "link_flexure") << printed.text;
  EXPECT_TRUE(added(printed, "link_flexure"));
  request.arm = BlindArm::kPlanarPublished;
  const Diagnosis published = diagnosed(request);
  ASSERT_TRUE(published.finding_after.has_value());
  EXPECT_EQ(*published.finding_after, Finding::kUnknown) << published.text_after;
  ASSERT_TRUE(published.unknown_after.has_value());
  const auto& inputs = published.unknown_after->pattern.depends_on;
  EXPECT_NE(std::find(inputs.begin(), inputs.end(), "q2"), inputs.end());
}

TEST(DiagnoseBadData, TwoEffectsThatMoveThePointAlikeAreUndecidable) {
  // Nothing but the weight of its last link bends the last joint and that link of a planar arm.
  const Cell cell = planar_cell(PlanarVariant::kPrinted);
  SimulationPlan plan;
  plan.poses = 200;
  plan.axes = {true, true, false};
  plan.noise_m = 20e-6;
  plan.repeats = 3;
  plan.truth.effects = {"joint_compliance:J2=300urad"};
  const Simulation arm = simulate(cell, plan);
  const Diagnosis d = diagnose(cell, arm.measured, {.apply = true, .tell = {}});
  EXPECT_EQ(d.finding, Finding::kUndecidable) << d.text;
  EXPECT_NE(d.text.find("the links of J2 bend"), std::string::npos) << d.text;
  EXPECT_NE(d.text.find("J2 yields under load"), std::string::npos) << d.text;
  EXPECT_LT(d.after.mean, 0.3 * d.before.mean) << "either of them serves";
}

}  // namespace
}  // namespace plumb::offline
