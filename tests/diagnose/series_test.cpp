// SPDX-License-Identifier: Apache-2.0
// An irregular gear is named as a series of whole waves; a single wave keeps its own name.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "diagnose/diagnosis.hpp"
#include "fit/calibrate.hpp"
#include "solve/series_numbers.hpp"
#include "tests/cases/blind_case.hpp"

namespace plumb::offline {
namespace {

BlindRequest hiding(std::vector<std::string> effects, int poses) {
  BlindRequest out;
  out.poses = poses;
  out.effects = std::move(effects);
  return out;
}

Diagnosis diagnosed(const BlindCase& blind) {
  Diagnosis out = diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
  std::printf("%s\n  %s\n", out.text.c_str(), out.text_after.c_str());
  return out;
}

bool names_a_series(const std::vector<EffectEntry>& effects) {
  return std::any_of(effects.begin(), effects.end(),
                     [](const EffectEntry& e) { return e.name == "joint_series"; });
}

ArmState fitted(const BlindCase& blind, const std::vector<EffectEntry>& effects) {
  Cell cell = blind.cell;
  cell.effects = effects;
  std::vector<int> rows(static_cast<std::size_t>(blind.measured.measured.size()));
  std::iota(rows.begin(), rows.end(), 0);
  return calibrate(cell, blind.measured.measured, rows).state;
}

/// Per-axis RMS from the truth on fresh poses [m].
double true_error(const ArmState& state, const Simulation& fresh) {
  const Rows3 error = fresh.true_p_M - predict_points(state, fresh.measured);
  return std::sqrt(error.squaredNorm() / static_cast<double>(error.size()));
}

TEST(DiagnoseSeries, AnIrregularGearIsNamedAndTheErrorFallsToTheNoise) {
  const BlindCase blind = make_blind_case(hiding({"joint_table:J2=200urad"}, 1500));
  const Diagnosis d = diagnosed(blind);
  ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
  const Candidate& best = d.candidates.front();
  EXPECT_EQ(best.entry.name, "joint_series");
  EXPECT_EQ(best.entry.joints, std::vector<int>{1}) << "the others' gears are even";
  EXPECT_NE(d.text.find("of J2"), std::string::npos) << d.text;
  EXPECT_FALSE(best.peaks.empty());
  EXPECT_LE(best.numbers.size(), 12U);
  EXPECT_LT(d.after.mean, 0.3 * d.before.mean);
  ASSERT_TRUE(d.held_out_excess);
  EXPECT_LT(d.held_out_excess->times, 1.25);

  const ArmState state = fitted(blind, d.effects), bare = fitted(blind, blind.cell.effects);
  EXPECT_LT(true_error(state, blind.fresh_robot), 0.2 * true_error(bare, blind.fresh_robot));

  // A whole turn of any joint further nothing is new.
  Measurements turned = blind.fresh_robot.measured;
  turned.q.col(0).array() += 2.0 * std::numbers::pi;
  turned.q.col(1).array() -= 2.0 * std::numbers::pi;
  const Rows3 there = predict_points(state, turned);
  const Rows3 here = predict_points(state, blind.fresh_robot.measured);
  EXPECT_LT((there - here).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(DiagnoseSeries, OneWaveOrTwoKeepTheirOwnName) {
  for (const auto& effects : {std::vector<std::string>{"gear_ripple:J2:5@cycles=17"},
                              std::vector<std::string>{"gear_ripple:J3:5@cycles=9.4"},
                              std::vector<std::string>{"gear_harmonics:J2:5"}}) {
    const Diagnosis d = diagnosed(make_blind_case(hiding(effects, 500)));
    ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
    EXPECT_NE(d.candidates.front().entry.name, "joint_series") << d.text;
    EXPECT_FALSE(names_a_series(d.effects)) << d.text_after;
  }
}

TEST(DiagnoseSeries, NoSeriesIsFoundInASpringOrInNothing) {
  for (const auto& effects :
       {std::vector<std::string>{}, std::vector<std::string>{"joint_compliance:J2:5"}}) {
    const Diagnosis d = diagnosed(make_blind_case(hiding(effects, 500)));
    EXPECT_FALSE(names_a_series(d.effects)) << d.text_after;
  }
}

}  // namespace
}  // namespace plumb::offline
