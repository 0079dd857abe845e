// SPDX-License-Identifier: Apache-2.0
#include "diagnose/certainty.hpp"

#include <gtest/gtest.h>

#include "diagnose/diagnosis_text.hpp"

namespace plumb::offline {
namespace {

EffectEntry effect(const std::string& name, int joint) {
  return {.name = name, .joints = {joint}, .options = {}, .place = {}};
}

ErrorStats error_of(double mean_m) {
  return {.n = 40, .mean = mean_m, .rms = mean_m, .p95 = 2.0 * mean_m, .max = 3.0 * mean_m};
}

/// An arm of three joints, and a diagnosis that found one effect beyond doubt.
struct Found {
  Cell cell;
  Diagnosis d;

  Found() {
    cell.nominal.joints.resize(3);
    for (int i = 0; i < 3; ++i) cell.nominal.joints[i].name = "J" + std::to_string(i + 1);
    cell.mechanics.resize(3);
    d.finding = Finding::kMissing;
    d.before = error_of(100e-6);
    d.after = d.before;
    d.floor = {.sigma_m = 10e-6, .mean_m = 16e-6, .rms_m = 17e-6, .dof = 20};
    d.floor.source = NoiseFloor::Source::kRepeats;
    Candidate first;
    first.entry = effect("joint_compliance", 1);
    first.title = "joint compliance";
    first.ln_bayes = 80.0;
    first.alone = error_of(20e-6);
    first.supported = true;
    d.candidates = {first};
  }
  Certainty judged() const { return certainty(cell, d); }
  std::string words() const { return verdict_text(cell, d); }
};

TEST(Certainty, OneEffectThatIsSetApartIsCertainAndTheSentenceSaysSo) {
  const Found found;
  EXPECT_EQ(found.judged(), Certainty::kCertain);
  EXPECT_NE(found.words().find("Certain."), std::string::npos) << found.words();
}

TEST(Certainty, WhatThesePosesCannotTellApartIsAOrB) {
  Found found;
  Alternative other;
  other.entry = effect("gear_harmonics", 1);
  found.d.alternatives = {other};
  EXPECT_EQ(found.judged(), Certainty::kAOrB);
  EXPECT_NE(found.words().find("these poses cannot tell"), std::string::npos) << found.words();
}

TEST(Certainty, AnEffectThatDoesNotHelpUnseenPosesIsDoubtful) {
  Found found;
  found.d.candidates.front().alone = error_of(104e-6);
  EXPECT_EQ(found.judged(), Certainty::kDoubtful);
  EXPECT_EQ(found.words().find("Doubtful"), 0U) << found.words();
}

TEST(Certainty, LittleEvidenceAnUnlikelySizeAndASmallPartAreDoubtful) {
  for (const int how : {0, 1, 2}) {
    Found found;
    Candidate& first = found.d.candidates.front();
    if (how == 0) first.ln_bayes = 6.0;
    if (how == 1) first.plausible = false;
    if (how == 2) first.alone = error_of(97e-6);
    EXPECT_EQ(found.judged(), Certainty::kDoubtful) << how;
    EXPECT_EQ(found.words().find("Certain."), std::string::npos) << found.words();
  }
}

TEST(Certainty, ANearRivalIsNeverCertain) {
  Found found;
  Candidate rival = found.d.candidates.front();
  rival.entry = effect("gear_harmonics", 1);
  rival.ln_bayes = 74.0;
  found.d.candidates.front().confounded_with = {"gear_harmonics:J2"};
  found.d.candidates.push_back(rival);
  EXPECT_EQ(found.judged(), Certainty::kAOrB);
  EXPECT_EQ(found.words().find("Certain"), std::string::npos) << found.words();
  found.d.candidates.back().ln_bayes = 40.0;
  EXPECT_EQ(found.judged(), Certainty::kCertain) << "far behind, it is no rival";
}

TEST(Certainty, NothingFoundIsNothingAndStructureWithoutALawIsDoubtful) {
  Found found;
  found.d.finding = Finding::kComplete;
  EXPECT_EQ(found.judged(), Certainty::kNothing);
  found.d.finding = Finding::kUndecidable;
  EXPECT_EQ(found.judged(), Certainty::kNothing);
  found.d.finding = Finding::kUnknown;
  EXPECT_EQ(found.judged(), Certainty::kDoubtful);
}

TEST(Certainty, AfterEverythingWasAddedItIsOfWhatIsLeft) {
  Found found;
  found.d.finding_after = Finding::kComplete;
  EXPECT_EQ(found.judged(), Certainty::kNothing);
  found.d.finding_after = Finding::kUndecidable;
  found.d.undecided = Undecided{};
  EXPECT_EQ(found.judged(), Certainty::kAOrB);
}

TEST(Certainty, GravityThatCertainlyActsOtherwiseIsTheCause) {
  Found found;
  found.d.finding = Finding::kUndecidable;
  found.d.gravity = OtherGravity{.stated = {0, 0, -9.81}, .found = {0, -9.81, 0}, .certain = true};
  EXPECT_EQ(found.judged(), Certainty::kCertain);
  found.d.gravity->certain = false;
  EXPECT_EQ(found.judged(), Certainty::kAOrB);
}

}  // namespace
}  // namespace plumb::offline
