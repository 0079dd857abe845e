// SPDX-License-Identifier: Apache-2.0
#include "diagnose/effect_sentence.hpp"

#include <gtest/gtest.h>

#include "answers/after_diagnosis.hpp"
#include "diagnose/diagnosis_text.hpp"
#include "diagnose/effect_words.hpp"
#include "effects/effect_option.hpp"
#include "effects/fitted_laws.hpp"
#include "show/check_view.hpp"
#include "show/diagnose_view.hpp"

namespace plumb::offline {
namespace {

Cell three_joints() {
  Cell cell;
  cell.nominal.joints.resize(3);
  for (int i = 0; i < 3; ++i) cell.nominal.joints[i].name = "J" + std::to_string(i + 1);
  return cell;
}

TEST(EffectSentence, EveryLawOfTheLibraryHasOneInPlainWords) {
  const Cell cell = three_joints();
  for (int law = 0; law < kFittedLaws; ++law) {
    const std::string name(fitted_law_info(law).name);
    if (name == "formula" || name == "step") continue;  // these name themselves
    const EffectEntry entry{.name = name, .joints = {1}, .options = {}, .place = {}};
    const std::string sentence = effect_sentence(cell, entry, {20.0});
    EXPECT_NE(sentence, in_words(cell, entry, {20.0})) << name;
    EXPECT_EQ(sentence.find('{'), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('_'), std::string::npos) << sentence;
  }
}

TEST(EffectSentence, SpeaksOfOneJointAndOfTwo) {
  const Cell cell = three_joints();
  EffectEntry entry{.name = "gravity_free", .joints = {1}, .options = {}, .place = {}};
  EXPECT_EQ(effect_sentence(cell, entry, {}), "J2 yields under gravity (masses not given)");
  entry.joints = {1, 2};
  EXPECT_EQ(effect_sentence(cell, entry, {}), "J2 and J3 yield under gravity (masses not given)");
  Cell heavy = cell;
  heavy.mechanics.resize(3);
  heavy.mechanics[1].link_mass_kg = 20.0;
  EXPECT_EQ(effect_sentence(heavy, entry, {}),
            "J2 and J3 yield under gravity (as if the masses were not those of cell.toml)");
}

TEST(EffectSentence, APartThatMovedSeveralTimesIsOneFinding) {
  const Cell cell = three_joints();
  Candidate found;
  found.entry = {.name = "step", .joints = {}, .options = {}, .place = {}};
  set_option(found.entry, OptionKey::kOf, std::string("base"));
  set_option(found.entry, OptionKey::kAfterRow, 41.0);
  found.moves = {{41.0, 0.31e-3}, {97.0, 0.22e-3}};
  EXPECT_EQ(
      effect_sentence(cell, found),
      "the tracker or the base moved twice: after row 41 by 0.31 mm, after row 97 by 0.22 mm");
  EXPECT_EQ(in_words(cell, found), "step of the base after rows 41 and 97 (step)");
  found.moves.push_back({120.0, 0.1e-3});
  EXPECT_NE(effect_sentence(cell, found).find("moved 3 times"), std::string::npos);
}

TEST(EffectSentence, ANegativeReversalIsOneThatIsOverCompensated) {
  const Cell cell = three_joints();
  Candidate found;
  found.entry = {.name = "reversal", .joints = {2}, .options = {}, .place = {}};
  found.numbers = {{"reversal.J3.h", "rad", -40e-6, 1e-6, 100e-6, true}};
  EXPECT_EQ(effect_sentence(cell, found), "J3 is over-compensated on reversal");
  found.numbers.front().value = 40e-6;
  EXPECT_EQ(effect_sentence(cell, found),
            "J3 stops short of the place, depending on the side it came from");
}

TEST(EffectSentence, TheNameOfAnEffectHoldsWhatTheCommandLineTakes) {
  const Cell cell = three_joints();
  const EffectEntry spring{
      .name = "gravity_compensator", .joints = {1}, .options = {}, .place = {}};
  EXPECT_EQ(in_words(cell, spring), "balancing spring (gravity_compensator:J2)");
  EXPECT_EQ(key_in_words("gravity_compensator:J2"), in_words(cell, spring));
  const EffectEntry ripple{.name = "gear_ripple", .joints = {1}, .options = {}, .place = {}};
  EXPECT_EQ(in_words(cell, ripple, {20.0, 8.5}),
            "gear ripple, 20 and 8.5 cycles a turn (gear_ripple:J2)");
  EXPECT_EQ(in_words(cell, ripple, {14.8, 3.0, 1.0}), "gear ripple, 3 waves (gear_ripple:J2)");
  EXPECT_EQ(effect_sentence(cell, ripple, {14.8, 3.0, 1.0}),
            "the gear of J2 turns unevenly, 3 waves, the largest at 14.8 cycles a turn");
}

TEST(EffectSentence, TheVerdictSaysHowSureItIsAndWhatElseItMayBe) {
  const Cell cell = three_joints();
  Diagnosis d;
  d.finding = Finding::kMissing;
  d.before.mean = 61e-6;
  Candidate best;
  best.entry = {.name = "gravity_free", .joints = {1}, .options = {}, .place = {}};
  best.ln_bayes = 437.0;
  best.alone.mean = 31e-6;
  d.candidates = {best};
  EXPECT_EQ(verdict_text(cell, d),
            "Missing: J2 yields under gravity (masses not given). Adding it: 0.061 -> 0.031 mm on "
            "unseen poses, noise floor unknown. Certain.");
  d.candidates.front().confounded_with = {"link_flexure:J2,J3"};
  EXPECT_EQ(verdict_text(cell, d).find("hardly"), std::string::npos) << "no rival is near";
  Candidate rival;
  rival.entry = {.name = "link_flexure", .joints = {1, 2}, .options = {}, .place = {}};
  rival.ln_bayes = 400.0;
  d.candidates.push_back(rival);
  EXPECT_EQ(verdict_text(cell, d).find("hardly"), std::string::npos) << "37 nats behind";
  d.candidates.back().ln_bayes = 430.0;
  EXPECT_NE(verdict_text(cell, d).find(
                "these poses hardly tell it from bending of links (link_flexure:J2+J3)."),
            std::string::npos)
      << verdict_text(cell, d);
  EXPECT_EQ(verdict_text(cell, d).find("Certain"), std::string::npos) << "7 nats ahead of another";
  EXPECT_NE(verdict_text(cell, d).find("Very likely"), std::string::npos);
  d.candidates.front().ln_bayes = 4.0;
  EXPECT_NE(verdict_text(cell, d).find("Likely"), std::string::npos);
}

TEST(EffectSentence, WhatIsCertainNeedsNoMeasurementToBeSure) {
  const Cell cell = three_joints();
  Diagnosis d;
  d.finding = Finding::kMissing;
  d.before.mean = 61e-6;
  Candidate best, rival;
  best.entry = {.name = "joint_compliance", .joints = {1}, .options = {}, .place = {}};
  best.ln_bayes = 437.0;
  best.alone.mean = 31e-6;
  best.confounded_with = {"gear_harmonics:J3", "gear_harmonics:J2"};
  rival.entry = {.name = "gear_harmonics", .joints = {1}, .options = {}, .place = {}};
  for (double behind = 0.0; behind < 40.0; behind += 1.0) {
    rival.ln_bayes = best.ln_bayes - behind;
    d.candidates = {best, rival};
    std::string next;
    for (const auto& line : after_diagnosis(cell, d)) next += line + "\n";
    const bool certain = verdict_text(cell, d).find("Certain") != std::string::npos;
    EXPECT_EQ(certain, behind >= 10.0) << behind;
    EXPECT_EQ(next.find("to be sure which it is") == std::string::npos, certain) << next;
    EXPECT_EQ(next.find("joint_compliance:J2,gear_harmonics:J2") == std::string::npos, certain);
  }
}

/// Poses cannot be planned for an arm whose ball rests in a socket.
TEST(EffectSentence, WhatTouchedPointsCannotTellIsNotToBePlanned) {
  Cell cell = three_joints();
  Diagnosis d;
  d.finding = Finding::kUndecidable;
  const auto next = [&] { return after_diagnosis(cell, d).front(); };
  EXPECT_TRUE(next().starts_with("plan ")) << next();
  cell.measurement.setups.emplace_back().reads = ReadingKind::kPoint;
  EXPECT_TRUE(next().starts_with("check ")) << next();
}

TEST(VerdictClass, IsThatOfTheFindingAndOfWhatTheDataAreGoodFor) {
  EXPECT_STREQ(show::class_of(Finding::kComplete), "good");
  for (const Finding finding : {Finding::kMissing, Finding::kUnknown, Finding::kUndecidable})
    EXPECT_STREQ(show::class_of(finding), "partly");
  Check check;
  EXPECT_EQ(show::check_verdict(check).found, "good");
  EXPECT_EQ(show::check_verdict(check).sentence, "Usable");
  check.moved = "the reflector slipped";
  EXPECT_EQ(show::check_verdict(check).found, "partly") << "it begins with Usable all the same";
  EXPECT_TRUE(show::check_verdict(check).sentence.starts_with("Usable only"));
  check.detection.changed = true;
  EXPECT_EQ(show::check_verdict(check).found, "bad");
}

}  // namespace
}  // namespace plumb::offline
