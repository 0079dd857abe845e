// SPDX-License-Identifier: Apache-2.0
#include "diagnose/finding.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace plumb::offline {
namespace {

struct Row {
  const char* what;
  Facts facts;
  Finding finding;
};

const std::vector<Row> kRows = {
    {"nothing", {}, Finding::kComplete},
    {"an effect", {.law = true}, Finding::kMissing},
    {"a pattern of no law", {.structure = true}, Finding::kUnknown},
    {"no noise floor", {.noise_known = false}, Finding::kUndecidable},
    {"much is left", {.excess = true}, Finding::kUndecidable},
    {"too few lines", {.judgeable = false}, Finding::kUndecidable},
    {"wrong gravity", {.wrong_gravity = true}, Finding::kUndecidable},
    {"or a law that is not shown", {.law = true, .law_not_shown = true}, Finding::kUndecidable},
    {"or a slow motion", {.law = true, .slow_motion = true}, Finding::kUndecidable},
    {"or its tie", {.law = true, .tied = true}, Finding::kUndecidable},
    {"or one that is not compiled", {.law = true, .other_fate = true}, Finding::kUndecidable},
    {"or another gravity", {.law = true, .other_gravity = true}, Finding::kUndecidable},
    {"refused", {.law = true, .refused = true}, Finding::kUndecidable},
    // Doubts of what was added stay, where nothing more is missing.
    {"added, or not shown", {.law_not_shown = true}, Finding::kUndecidable},
    {"added, or slow", {.slow_motion = true}, Finding::kUndecidable},
    {"added, or its tie", {.tied = true}, Finding::kUndecidable},
    {"not added", {.other_fate = true}, Finding::kUndecidable},
    // Gravity and a refusal doubt a law that is missing; without one they say nothing.
    {"gravity, and no law", {.other_gravity = true}, Finding::kComplete},
    {"refused, and no law left", {.refused = true}, Finding::kComplete},
    // What goes first.
    {"too few lines for a pattern", {.judgeable = false, .structure = true}, Finding::kUndecidable},
    {"too few lines for an effect", {.judgeable = false, .law = true}, Finding::kUndecidable},
    {"a pattern under wrong gravity",
     {.wrong_gravity = true, .structure = true},
     Finding::kUndecidable},
    {"a pattern before an effect", {.structure = true, .law = true}, Finding::kUnknown},
    {"a pattern beside a doubt",
     {.structure = true, .law_not_shown = true, .tied = true},
     Finding::kUnknown},
    {"a pattern without a noise floor",
     {.structure = true, .noise_known = false},
     Finding::kUnknown},
    {"a pattern, and much is left", {.structure = true, .excess = true}, Finding::kUnknown},
    {"an effect without a noise floor", {.law = true, .noise_known = false}, Finding::kMissing},
    {"an effect, and much is left", {.law = true, .excess = true}, Finding::kMissing},
};

TEST(DecideFinding, FollowsFromTheFactsAsTheTableSays) {
  for (const Row& row : kRows) EXPECT_EQ(decide(row.facts), row.finding) << row.what;
}

constexpr std::array kFacts = {&Facts::judgeable, &Facts::wrong_gravity, &Facts::structure,
                               &Facts::law,       &Facts::law_not_shown, &Facts::slow_motion,
                               &Facts::tied,      &Facts::other_fate,    &Facts::other_gravity,
                               &Facts::refused,   &Facts::noise_known,   &Facts::excess};

std::vector<Facts> every_combination() {
  static_assert(sizeof(Facts) == kFacts.size(), "a fact is in no combination");
  std::vector<Facts> out;
  for (unsigned bits = 0; bits < 1U << kFacts.size(); ++bits) {
    Facts facts;
    for (std::size_t i = 0; i < kFacts.size(); ++i) facts.*kFacts[i] = (bits >> i & 1U) != 0;
    out.push_back(facts);
  }
  return out;
}

/// What each finding claims, by itself.
std::vector<Finding> claims_that_hold(const Facts& f) {
  const bool can_tell = f.judgeable && !f.wrong_gravity;
  const bool sure = !f.law_not_shown && !f.slow_motion && !f.tied && !f.other_fate;
  const bool law_is_sure = !f.other_gravity && !f.refused;
  const bool at_the_floor = f.noise_known && !f.excess;
  std::vector<Finding> out;
  if (can_tell && f.structure) out.push_back(Finding::kUnknown);
  if (can_tell && !f.structure && sure && f.law && law_is_sure) out.push_back(Finding::kMissing);
  if (can_tell && !f.structure && sure && !f.law && at_the_floor) out.push_back(Finding::kComplete);
  if (!can_tell ||
      (!f.structure && (!sure || (f.law && !law_is_sure) || (!f.law && !at_the_floor))))
    out.push_back(Finding::kUndecidable);
  return out;
}

TEST(DecideFinding, ExactlyOneComesOutForEveryCombinationOfFacts) {
  for (const Facts& facts : every_combination()) {
    const std::vector<Finding> holds = claims_that_hold(facts);
    ASSERT_EQ(holds.size(), 1U);
    ASSERT_EQ(decide(facts), holds.front());
  }
}

TEST(DecideFinding, OneMoreDoubtNeverMakesADiagnosisSurer) {
  constexpr std::array doubts = {&Facts::law_not_shown, &Facts::slow_motion,   &Facts::tied,
                                 &Facts::other_fate,    &Facts::other_gravity, &Facts::refused,
                                 &Facts::wrong_gravity, &Facts::excess};
  for (const Facts& facts : every_combination())
    for (const auto doubt : doubts) {
      Facts doubted = facts;
      doubted.*doubt = true;
      const Finding after = decide(doubted);
      EXPECT_TRUE(after == decide(facts) || after == Finding::kUndecidable);
    }
}

}  // namespace
}  // namespace plumb::offline
