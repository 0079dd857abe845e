// SPDX-License-Identifier: Apache-2.0
// Structure that no law of the library explains comes with formulas that predict unseen poses; an
// arm that hides nothing of that kind comes with none.
#include "diagnose/formula_proposal.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "cell/formula_reader.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/formula_choice.hpp"
#include "diagnose/formula_offer.hpp"
#include "diagnose/formula_terms.hpp"
#include "diagnose/formula_words.hpp"
#include "diagnose/regressor.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "fit/fit_cell.hpp"
#include "tests/diagnose/hiding.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

enum class Apply { kNo, kYes };

Diagnosis diagnosed(const BlindRequest& request, Apply apply = Apply::kNo) {
  const BlindCase blind = make_blind_case(request);
  return diagnose(blind.cell, blind.measured.measured, {.apply = apply == Apply::kYes, .tell = {}});
}

bool reads(const FormulaOffer& offer, const std::string& name) {
  return formula_text(offer.entry).expression.find(name) != std::string::npos;
}

constexpr double kNearTheFloor = 1.5;

struct Outside {
  std::string hidden;
  std::string moves;
  std::vector<std::string> reads;
};

TEST(FormulaOffers, ReadTheRightInputsAndComeNearTheNoiseFloor) {
  for (const Outside& one : {Outside{"joint_product:J5:5@a=4,b=6", "dq5", {"q4", "q6"}},
                             Outside{"folded_sine:J5:5@from=3", "dq5", {"q3"}},
                             Outside{"growing:J3:5@from=1", "dq3", {"q1"}},
                             Outside{"directed_sine:J5:5@from=2", "dq5", {"q2", "dir5"}},
                             Outside{"joint_memory:J3:5", "dq3", {"q3", "travel3"}},
                             Outside{"warm_encoder:J3:5", "dq3", {"temp"}}}) {
    const Diagnosis d = diagnosed(hiding({one.hidden}, 150));
    ASSERT_FALSE(d.formulas.empty()) << one.hidden << ": " << d.text;
    ASSERT_LE(d.formulas.size(), kMostFormulas);
    const FormulaOffer& first = d.formulas.front();
    EXPECT_EQ(formula_text(first.entry).target, one.moves) << law_of(first);
    for (const auto& name : one.reads) EXPECT_TRUE(reads(first, name)) << law_of(first);
    EXPECT_LT(first.after.mean, kNearTheFloor * d.floor.mean_m) << one.hidden << law_of(first);
    for (std::size_t i = 1; i < d.formulas.size(); ++i)
      EXPECT_LE(d.formulas[i].nats, d.formulas[i - 1].nats) << one.hidden;
  }
}

TEST(FormulaOffers, AreNotMadeForAnArmThatHidesNothingOrAKnownEffect) {
  for (const auto& hidden : {std::vector<std::string>{},
                             {"joint_compliance:J2:5"},
                             {"gear_harmonics:J3:2"},
                             {"reversal:J4:5"},
                             {"drift::5"}})
    for (const std::uint64_t seed : {1U, 2U}) {
      const Diagnosis d = diagnosed(hiding(hidden, 100, seed));
      EXPECT_TRUE(d.formulas.empty()) << d.text;
    }
}

TEST(FormulaOffers, AreOnlyOfferedWhereEffectsAreAdded) {
  const Diagnosis d = diagnosed(hiding({"joint_product:J5:5@a=4,b=6"}, 150), Apply::kYes);
  ASSERT_EQ(d.finding_after, Finding::kUnknown) << d.text_after;
  EXPECT_FALSE(d.formulas.empty());
  EXPECT_TRUE(std::none_of(d.effects.begin(), d.effects.end(),
                           [](const EffectEntry& e) { return is_formula(e.name); }));
}

TEST(FormulaOffers, PromiseTheErrorThatTheOrdinaryFitThenHas) {
  const BlindCase blind = make_blind_case(hiding({"joint_product:J5:5@a=4,b=6"}, 150));
  const Diagnosis d = diagnose(blind.cell, blind.measured.measured, {.apply = false, .tell = {}});
  ASSERT_FALSE(d.formulas.empty());
  Cell with = blind.cell;
  with.effects.push_back(d.formulas.front().entry);
  const Fit fit = fit_cell(with, blind.measured.measured);
  EXPECT_NEAR(fit.held.mean, d.formulas.front().after.mean, 0.02 * fit.held.mean);
}

TEST(FormulaOffers, AreDrawnAsTheirNumbersSay) {
  const Diagnosis d = diagnosed(hiding({"growing:J3:5@from=1"}, 150));
  ASSERT_FALSE(d.formulas.empty());
  const FormulaOffer& first = d.formulas.front();
  ASSERT_EQ(first.curve.size(), static_cast<std::size_t>(kFormulaCurve));
  EXPECT_EQ(first.input, "q1");
  EXPECT_EQ(first.input_unit, "rad");
  for (std::size_t i = 1; i < first.curve.size(); ++i)
    EXPECT_GT(first.curve[i].input, first.curve[i - 1].input);
}

TEST(FormulaTerms, AreAllUnderstoodByTheCellFile) {
  const WhitenedFit& s = whitened_arm().whitened;
  for (const auto& depends_on : {std::vector<std::string>{"q4"},
                                 {"q4", "q6"},
                                 {"previous q2"},
                                 {"direction q2"},
                                 {"t"},
                                 {s.sensors.front()}}) {
    Pattern pattern{.subject = "joint 5", .words = "", .depends_on = depends_on};
    pattern.joint = 4;
    pattern.harmonic = 1.5;
    const auto inputs = formula_inputs(s, pattern);
    const auto terms = formula_terms(pattern, inputs, inputs);
    ASSERT_FALSE(terms.empty()) << depends_on.front();
    for (const auto& term : terms) {
      EffectEntry entry = entry_of(formula_effect());
      entry.options["target"] = std::string("dq5");
      entry.options["expression"] = "k1*" + term.text;
      entry.options["parameters"] = std::vector<std::string>{
          term.unit == "1" ? "k1 [rad] ~ 1e-4" : "k1 [rad/(" + term.unit + ")] ~ 1e-6"};
      FormulaProblems problems;
      compile_formula(formula_text(entry), formula_arm(s.cell->nominal), problems);
      EXPECT_TRUE(problems.empty()) << term.text << ": " << problems.front().message;
    }
  }
}

Regressor of_joint_5(const std::vector<FormulaTerm>& terms) {
  Regressor out;
  out.joint = 4;
  out.columns.resize(terms.front().value.size(), static_cast<Eigen::Index>(terms.size()));
  out.typical = Eigen::VectorXd::Constant(out.columns.cols(), kAngle_rad);
  for (std::size_t c = 0; c < terms.size(); ++c)
    out.columns.col(static_cast<Eigen::Index>(c)) = terms[c].value * kAngle_rad;
  return out;
}

std::vector<FormulaTerm> terms_of_q4(const WhitenedFit& s) {
  Pattern pattern{.subject = "joint 5", .words = "", .depends_on = {"q4"}};
  pattern.joint = 4;
  const auto inputs = formula_inputs(s, pattern);
  return formula_terms(pattern, inputs, inputs);
}

TEST(FormulaChoices, FindTheTermThatIsThere) {
  const WhitenedFit& s = whitened_arm().whitened;
  const auto terms = terms_of_q4(s);
  const auto there = std::find_if(terms.begin(), terms.end(),
                                  [](const FormulaTerm& t) { return t.text == "cos(2*q4)*dir5"; });
  ASSERT_NE(there, terms.end());
  const WhitenedFit left =
      leaving(s, noise_of(s, 1) + motion_of_size(s, of_joint_5({*there}), 3.0));
  const auto choices = choose_formulas(Scorer(left), of_joint_5(terms), terms);
  ASSERT_FALSE(choices.empty());
  EXPECT_EQ(choices.front().terms,
            std::vector<std::size_t>{static_cast<std::size_t>(there - terms.begin())});
}

TEST(FormulaChoices, FindNothingInNoise) {
  const WhitenedFit& s = whitened_arm().whitened;
  const auto terms = terms_of_q4(s);
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    EXPECT_TRUE(
        choose_formulas(Scorer(leaving(s, noise_of(s, seed))), of_joint_5(terms), terms).empty())
        << seed;
}

TEST(FormulaChoices, TakeNothingThatAFoldContradicts) {
  const WhitenedFit& s = whitened_arm().whitened;
  const auto terms = terms_of_q4(s);
  Eigen::VectorXd motion = motion_of_size(s, of_joint_5({terms.front()}), 3.0);
  ASSERT_FALSE(
      choose_formulas(Scorer(leaving(s, noise_of(s, 1) + motion)), of_joint_5(terms), terms)
          .empty());
  const Segment& fold = s.folds[1];
  motion.segment(s.table.begin(fold.begin), s.table.count(fold.begin, fold.end)) *= -1.0;
  EXPECT_TRUE(choose_formulas(Scorer(leaving(s, noise_of(s, 1) + motion)), of_joint_5(terms), terms)
                  .empty());
}

TEST(FormulaWords, SayTheLawItsSizeAndHowToAddIt) {
  FormulaOffer offer;
  offer.entry = entry_of(formula_effect());
  offer.entry.options["target"] = std::string("dq5");
  offer.entry.options["expression"] = std::string("k1*sin(q4)*cos(q6)");
  offer.entry.options["parameters"] = std::vector<std::string>{"k1 [rad] ~ 0.0001"};
  offer.numbers = {{"k1", "rad", 320e-6, 2e-6}};
  offer.before.mean = 106e-6;
  offer.after.mean = 19e-6;
  const Cell& cell = *whitened_arm().whitened.cell;
  EXPECT_EQ(formula_sentence(cell, offer, 0),
            "A law that fits: dq5 = k1*sin(q4)*cos(q6) (k1 = 320 µrad): held-out error 0.106 -> "
            "0.019 mm.");
  EXPECT_EQ(formula_sentence(cell, offer, 1),
            "Another one: dq5 = k1*sin(q4)*cos(q6) (k1 = 320 µrad): held-out error 0.106 -> "
            "0.019 mm. Add it: plumb add formula --formula 'dq5 = k1*sin(q4)*cos(q6)' --parameter "
            "'k1 [rad] ~ 0.0001'");
}

}  // namespace
}  // namespace plumb::offline
