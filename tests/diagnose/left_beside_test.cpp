// SPDX-License-Identifier: Apache-2.0
// What was added beside a cause that the library does not have may be a part of it.
#include "diagnose/left_beside.hpp"

#include <gtest/gtest.h>

#include "diagnose/diagnosis_text.hpp"
#include "simulate/study_arms.hpp"

namespace plumb::offline {
namespace {

constexpr double kFloor_m = 10e-6;

Addition added(const char* name, std::vector<int> joints, double rms_m) {
  Addition out;
  out.entry.name = name;
  out.entry.joints = std::move(joints);
  out.held.rms = out.held.mean = rms_m;
  return out;
}

/// From 100 um by two effects to 60 and then to 45 um.
Diagnosis two_effects(bool lack_of_fit) {
  Diagnosis d;
  d.finding = Finding::kMissing;
  d.finding_after = lack_of_fit ? Finding::kUndecidable : Finding::kComplete;
  d.floor = {
      .sigma_m = 6e-6, .mean_m = kFloor_m, .rms_m = kFloor_m, .source = NoiseFloor::Source::kSigma};
  d.before.rms = d.before.mean = 100e-6;
  d.added = {added("base_compliance", {}, 60e-6), added("axis_wobble", {1}, 45e-6)};
  d.after = d.added.back().held;
  d.held_out_excess = HeldOutExcess{.times = lack_of_fit ? 4.5 : 1.0};
  Candidate first;
  first.entry = d.added.back().entry;
  first.ln_bayes = 100.0;
  first.alone = d.after;
  d.candidates = {first};
  return d;
}

bool says(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

TEST(LeftBeside, AnEffectThatTookAwayLessThanIsLeftMayBeAPartOfAnotherCause) {
  // 100^2 - 60^2 is more than 45^2 - 10^2, and 60^2 - 45^2 is less.
  const Diagnosis d = two_effects(true);
  EXPECT_EQ(part_of(d, d.added[0]), PartOf::kNothing);
  EXPECT_EQ(part_of(d, d.added[1]), PartOf::kLargerRest);
}

TEST(LeftBeside, AtTheNoiseNothingIsMarked) {
  const Diagnosis d = two_effects(false);
  for (const auto& one : d.added) EXPECT_EQ(part_of(d, one), PartOf::kNothing);
}

TEST(LeftBeside, UnknownStructureAtTheJointMarksWhatActsThere) {
  Diagnosis d = two_effects(false);
  d.after.rms = 12e-6;
  d.unknown_after = UnknownStructure{};
  d.unknown_after->pattern.joint = 1;
  EXPECT_EQ(part_of(d, d.added[0]), PartOf::kNothing) << "it is no effect of that joint";
  EXPECT_EQ(part_of(d, d.added[1]), PartOf::kRestOfItsJoint);
  d.unknown_after->pattern.slow = true;
  EXPECT_EQ(part_of(d, d.added[1]), PartOf::kNothing) << "what moves with time is another cause";
}

TEST(LeftBeside, TheVerdictSaysSoAndIsNotCertain) {
  const Cell cell = sim::heavy_arm();
  const Diagnosis complete = two_effects(false);
  EXPECT_TRUE(says(verdict_text(cell, complete), "Certain.")) << verdict_text(cell, complete);
  const Diagnosis d = two_effects(true);
  ASSERT_NE(part_of_first(d), PartOf::kNothing);
  EXPECT_FALSE(says(verdict_text(cell, d), "Certain")) << verdict_text(cell, d);
  EXPECT_TRUE(says(verdict_text(cell, d), "Perhaps: "));
  EXPECT_TRUE(says(verdict_text(cell, d), "more is left than it explains"));
  EXPECT_TRUE(says(verdict_after_text(cell, d), "may be a part of another cause"))
      << verdict_after_text(cell, d);
}

}  // namespace
}  // namespace plumb::offline
