// SPDX-License-Identifier: Apache-2.0
// A diagnosis says what it found and no more: nothing twice, nothing that does not help, nothing
// left unsaid.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "diagnose/change_points.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/diagnosis_text.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/evidence.hpp"
#include "diagnose/rms_reduction.hpp"
#include "diagnose/scan.hpp"
#include "fit/calibrate.hpp"
#include "fit/few_poses.hpp"
#include "fit/held_out_excess.hpp"
#include "tests/cases/blind_case.hpp"

namespace plumb::offline {
namespace {

BlindRequest hiding(const std::string& effect, int poses = 150) {
  BlindRequest out;
  out.poses = poses;
  out.effects = {effect};
  return out;
}

Diagnosis diagnosed(const BlindRequest& request) {
  const BlindCase blind = make_blind_case(request);
  return diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
}

/// A calibrated arm and the whitened fit of all its poses.
struct Looked {
  BlindCase blind;
  Cell cell;
  Calibration calibration;
  WhitenedFit whitened;
  explicit Looked(const BlindRequest& request) : blind(make_blind_case(request)), cell(blind.cell) {
    calibration = calibrate(cell, blind.measured.measured, rows());
    whitened = make_whitened_fit(cell, blind.measured.measured, calibration,
                                 without_outliers(rows(), calibration.outliers), {});
  }
  Looked(const Looked&) = delete;
  std::vector<int> rows() const {
    std::vector<int> out(static_cast<std::size_t>(blind.measured.measured.size()));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<int>(i);
    return out;
  }
};

TEST(DiagnoseHonest, NeverOffersWhatTheModelHoldsEvenIfRefinementEndsThere) {
  Looked at(hiding("joint_compliance_soft:J2:5"));
  const Scan before = scan(at.whitened, {}, {});
  const Found* soft = before.find(at.cell, "joint_compliance_soft:J2");
  ASSERT_NE(soft, nullptr);
  at.cell.effects.push_back(soft->entry);
  for (const auto& found : scan(at.whitened, {}, {}).library)
    for (const auto& entry : found.entries())
      EXPECT_FALSE(has_effect(at.cell.effects, entry)) << key_of(at.cell, entry);
}

TEST(DiagnoseHonest, ConstantsOfEveryCandidateHaveFewDigits) {
  const Looked at(hiding("drift::5"));
  for (const auto& found : scan(at.whitened, {}, {}).library)
    for (const auto& [key, value] : found.entry.options)
      if (const auto* number = std::get_if<double>(&value)) {
        EXPECT_NEAR(*number, std::stod(fmt::format("{:.5g}", *number)), 1e-12 * std::abs(*number))
            << found.entry.name << " " << key;
      }
}

TEST(DiagnoseHonest, ARefitThatBringsNothingIsNoFall) {
  const Looked at(hiding("gear_harmonics:J2:5"));
  const auto& measured = at.blind.measured.measured;
  EXPECT_EQ(rms_reduction(at.cell, measured, at.rows(), at.calibration, at.calibration), 0.0);
  Cell with = at.cell;
  with.effects.push_back({.name = "gear_harmonics", .joints = {1}, .options = {}, .place = {}});
  const Calibration better = calibrate(with, measured, at.rows());
  EXPECT_GT(rms_reduction(at.cell, measured, at.rows(), at.calibration, better), 0.5);
}

TEST(DiagnoseHonest, WhatIsNotFiniteIsNeverEvidence) {
  const Eigen::MatrixXd gram = Eigen::MatrixXd::Constant(2, 2, NAN);
  const Evidence none = evidence(gram, Eigen::Vector2d(1.0, 2.0), 3.0, {.lines = 100.0});
  EXPECT_EQ(none.ln_bayes, kImpossible);
}

TEST(DiagnoseHonest, AJointThatTurnedOnForEverIsNoCrash) {
  BlindCase blind = make_blind_case({});
  blind.measured.measured.q(20, 1) = 1.7e5;
  try {
    diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
  } catch (const Failure& failure) {
    EXPECT_FALSE(std::string(failure.what()).empty());
  }
}

TEST(DiagnoseHonest, APointThatIsNoNumberIsRefused) {
  BlindCase blind = make_blind_case({});
  blind.measured.measured.p_M(20, 1) = 1e308;
  EXPECT_THROW(diagnose(blind.cell, blind.measured.measured, {}), Failure);
}

TEST(DiagnoseHonest, AFastRippleIsFoundAndItsSlowShadowsAreNot) {
  const Diagnosis d = diagnosed(hiding("gear_ripple:J3:5@cycles=60", 300));
  ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
  const Candidate& first = d.candidates.front();
  EXPECT_EQ(first.entry.name, "gear_ripple");
  EXPECT_EQ(first.entry.joints, std::vector<int>{2});
  ASSERT_FALSE(first.cycles.empty());
  EXPECT_NEAR(first.cycles.front(), 60.0, 0.3);
  EXPECT_LT(d.after.mean, 0.5 * d.before.mean);
}

TEST(DiagnoseHonest, ALargeButTrueEffectIsFlaggedAndNotUnknown) {
  const Diagnosis d = diagnosed(hiding("encoder_scale:J5:8", 300));
  ASSERT_TRUE(d.finding_after.has_value());
  EXPECT_NE(*d.finding_after, Finding::kUnknown) << d.text_after;
  ASSERT_FALSE(d.unlikely.empty()) << d.text_after;
  EXPECT_EQ(d.unlikely.front().entry.name, "encoder_scale");
  EXPECT_NE(d.text_after.find("unlikely size"), std::string::npos) << d.text_after;
}

TEST(DiagnoseHonest, WhatIsLeftIsMeasuredAgainstWhatSoFewPosesMakeUnavoidable) {
  NoiseFloor floor;
  EXPECT_FALSE(held_out_excess(1e-4, floor, 1.0).has_value()) << "no floor is known";
  floor.source = NoiseFloor::Source::kSigma;
  floor.mean_m = 1e-4;
  EXPECT_NEAR(error_growth(334.0, 33.0), std::sqrt(1.11), 1e-12);
  EXPECT_TRUE(held_out_excess(1.5e-4, floor, unavoidable_ratio(3000.0, 33.0))->lack_of_fit());
  EXPECT_FALSE(held_out_excess(1.5e-4, floor, unavoidable_ratio(108.0, 33.0))->lack_of_fit());
}

TEST(DiagnoseHonest, SaysInTheSentenceThatSomethingIsLeft) {
  const Cell cell;
  Diagnosis d;
  d.floor.source = NoiseFloor::Source::kSigma;
  d.floor.mean_m = 1e-5;
  d.before.mean = 3.1e-5;
  d.held_out_excess = HeldOutExcess{.times = 3.1, .unavoidable = 1.05};
  EXPECT_NE(verdict_text(cell, d).find("what is left is 3.1 times the noise floor"),
            std::string::npos)
      << verdict_text(cell, d);
  d.held_out_excess = HeldOutExcess{.times = 1.1, .unavoidable = 1.05};
  EXPECT_EQ(verdict_text(cell, d).find("left"), std::string::npos) << verdict_text(cell, d);
}

TEST(DiagnoseHonest, NeverCallsARiseAFall) {
  const Cell cell;
  Diagnosis d;
  d.finding = Finding::kMissing;
  d.before.mean = 196e-6;
  d.candidates.emplace_back();
  d.candidates.front().entry.name = "drift";
  d.candidates.front().alone.mean = 205e-6;
  EXPECT_EQ(verdict_text(cell, d).find("falls"), std::string::npos) << verdict_text(cell, d);
  EXPECT_NE(verdict_text(cell, d).find("does not fall (0.196 mm -> 0.205 mm)"), std::string::npos);
  EXPECT_EQ(verdict_text(cell, d).find("Certain"), std::string::npos) << verdict_text(cell, d);
  EXPECT_EQ(verdict_text(cell, d).find("Missing"), std::string::npos) << verdict_text(cell, d);
}

TEST(DiagnoseHonest, IsNotCertainOfACauseThatExplainsHardlyAnything) {
  const Cell cell;
  Diagnosis d;
  d.finding = Finding::kMissing;
  d.floor.source = NoiseFloor::Source::kSigma;
  d.floor.mean_m = 16e-6;
  d.before.mean = 201e-6;
  d.candidates.emplace_back();
  Candidate& best = d.candidates.front();
  best.entry.name = "drift";
  best.ln_bayes = 40.0;
  const auto text = [&](double after_m) {
    best.alone.mean = after_m;
    return verdict_text(cell, d);
  };
  EXPECT_EQ(text(195e-6).find("Certain"), std::string::npos) << text(195e-6);
  EXPECT_EQ(text(195e-6).find("Missing"), std::string::npos) << text(195e-6);
  EXPECT_NE(text(195e-6).find("It explains 3 % of the error only"), std::string::npos);
  EXPECT_NE(text(100e-6).find("Certain"), std::string::npos) << text(100e-6);
  d.before.mean = 20e-6;  // nearly all of what is left is the noise
  EXPECT_NE(text(19e-6).find("Certain"), std::string::npos) << text(19e-6);
}

TEST(DiagnoseHonest, NeverSaysZeroTimesTheUsualSize) {
  const Cell cell;
  Diagnosis d;
  d.finding_after = Finding::kUnknown;
  d.unknown_after.emplace();
  d.unknown_after->pattern = {.subject = "joint 3", .words = "depends on q2", .depends_on = {"q2"}};
  d.unknown_after->instead =
      Oversized{.entry = {.name = "drift", .joints = {}, .options = {}, .place = {}},
                .times = 0.0,
                .possible = false};
  const std::string text = verdict_after_text(cell, d);
  EXPECT_EQ(text.find(" 0 times"), std::string::npos) << text;
  EXPECT_NE(text.find("its law rules out"), std::string::npos) << text;
}

TEST(DiagnoseHonest, AnotherPayloadFromOnePoseOnIsNoSlippedEncoder) {
  Looked at(BlindRequest{});
  std::vector<Eigen::Index> order(static_cast<std::size_t>(at.whitened.fit_poses()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) {
    return at.whitened.context[a].order < at.whitened.context[b].order;
  });
  // The joint sagged and the payload changed behind half of the poses.
  const std::size_t half = order.size() / 2;
  for (std::size_t i = 0; i < order.size(); ++i) {
    at.whitened.context[order[i]].known.payload_kg = i < half ? 0.0 : 20.0;
    if (i < half) continue;
    for (Eigen::Index line = 3 * order[i]; line < 3 * order[i] + 3; ++line)
      at.whitened.y(line) += 5e-4 * at.whitened.joint[2](line);
  }
  const auto U = at.whitened.U.topRows(at.whitened.fit_lines);
  const Eigen::VectorXd kept = U.transpose() * at.whitened.y.head(at.whitened.fit_lines);
  at.whitened.y.head(at.whitened.fit_lines) -= U * kept;
  at.whitened.Q = at.whitened.y.head(at.whitened.fit_lines).squaredNorm();
  const double row = at.whitened.context[order[half]].order;
  int tried = 0;
  for (const auto& point : change_points(at.whitened, tried))
    if (!point.entry.joints.empty()) {
      EXPECT_GT(std::abs(std::get<double>(point.entry.options.at("after_row")) - row), 0.6)
          << key_of(at.cell, point.entry);
    }
}

/// The rows behind which the truth says that something moved: the last ones before it, from 1.
std::vector<double> true_moves(const BlindCase& blind) {
  const auto truth = nlohmann::json::parse(blind.truth_json);
  std::vector<double> out;
  const std::function<void(const nlohmann::json&)> look = [&](const nlohmann::json& at) {
    if (at.is_object() && at.contains("row_after"))
      out.push_back(at["row_after"].get<double>());
    else if (at.is_structured())
      for (const auto& part : at) look(part);
  };
  look(truth);
  return out;
}

TEST(DiagnoseHonest, ASetUpThatMovesTwiceIsOneFindingWithBothMoments) {
  for (const std::string law : {"two_steps_base", "two_steps_reflector"}) {
    BlindRequest request = hiding(law + "::5");
    request.masses = StatedMasses::kRight;
    const BlindCase blind = make_blind_case(request);
    const Diagnosis d = diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
    ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
    const Candidate& first = d.candidates.front();
    EXPECT_EQ(first.entry.name, "step");
    const std::vector<double> truth = true_moves(blind);
    ASSERT_EQ(truth.size(), 2U) << blind.truth_json;
    ASSERT_EQ(first.moves.size(), 2U) << d.text;
    for (std::size_t i = 0; i < 2; ++i) {
      // Readings that are held out may lie beside the cut: the middle of them is named.
      EXPECT_NEAR(first.moves[i].after_row, truth[i], 2.0) << law;
      EXPECT_GT(first.moves[i].size_m, 0.0);
    }
    EXPECT_NE(d.text.find("moved twice"), std::string::npos) << d.text;
    ASSERT_EQ(d.added.size(), 1U) << d.text_after;
    EXPECT_EQ(std::count_if(d.effects.begin(), d.effects.end(),
                            [](const EffectEntry& e) { return e.name == "step"; }),
              2);
    EXPECT_LT(d.after.mean, d.before.mean);
  }
}

TEST(DiagnoseHonest, ASetUpThatMovesOnceMovedOnce) {
  const Diagnosis d = diagnosed(hiding("step_base::5"));
  ASSERT_FALSE(d.candidates.empty());
  EXPECT_EQ(d.candidates.front().entry.name, "step");
  EXPECT_TRUE(d.candidates.front().moves.empty()) << d.text;
}

BlindRequest yielding_under(const std::array<double, 3>& gravity) {
  BlindRequest out = hiding("joint_compliance:J2:5");
  out.masses = StatedMasses::kRight;
  out.imperfections.gravity = gravity;
  return out;
}

/// A second effect that looks like the scatter of a joint must not make the first one look better
/// than it is: the promised fall is that of the error in millimetres.
TEST(DiagnoseHonest, ThePromisedFallIsThatOfTheErrorNotOfTheWhitenedOne) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    BlindRequest request = hiding("overcompensated_reversal:J4:5", 500);
    request.effects.push_back("joint_compliance:J2:2");
    request.seed = seed;
    const Diagnosis d = diagnosed(request);
    ASSERT_FALSE(d.added.empty());
    const Candidate& first = d.candidates.front();
    EXPECT_NEAR(first.gain, 1.0 - first.alone.rms / d.before.rms, 0.02) << d.text;
    EXPECT_NEAR(first.alone.rms, d.added.front().held.rms, 0.05 * first.alone.rms) << d.text;
  }
}

TEST(DiagnoseHonest, GravityThatActsElsewhereIsNamedAndNothingIsAddedUnderTheWrongOne) {
  for (const auto& gravity : {std::array{0.0, 0.0, 9.81}, std::array{0.0, -9.81, 0.0}}) {
    const BlindCase blind = make_blind_case(yielding_under(gravity));
    const Diagnosis d = diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
    ASSERT_TRUE(d.gravity.has_value()) << d.text;
    EXPECT_TRUE(d.gravity->certain) << d.text;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(d.gravity->found[k], gravity[k], 0.6) << d.text;
    EXPECT_EQ(d.finding, Finding::kMissing);
    EXPECT_EQ(d.candidates.front().entry.name, "joint_compliance") << d.text;
    EXPECT_EQ(d.candidates.front().entry.joints, std::vector<int>{1}) << d.text;
    EXPECT_NE(d.text.find("Gravity acts along"), std::string::npos) << d.text;
    EXPECT_TRUE(d.added.empty());
    EXPECT_EQ(d.effects.size(), blind.cell.effects.size());
  }
}

TEST(DiagnoseHonest, GravityThatActsAsStatedIsLeftAlone) {
  for (const std::string effect : {"joint_compliance:J2:5", "drift::5"}) {
    BlindRequest request = hiding(effect);
    request.masses = StatedMasses::kRight;
    EXPECT_FALSE(diagnosed(request).gravity.has_value()) << effect;
  }
}

}  // namespace
}  // namespace plumb::offline
