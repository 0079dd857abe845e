// SPDX-License-Identifier: Apache-2.0
#include "diagnose/rivals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "diagnose/constants.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

/// A library of few laws, so that a scan is cheap.
struct Rivals : testing::Test {
  Rivals() {
    const std::set<std::string> tried = {"gear_harmonics", "tool_sag", "base_compliance"};
    for (const EffectDescriptor* effect : effect_descriptors())
      if (!tried.contains(std::string(effect->name))) not_testable.emplace_back(effect->name);
  }
  /// What is left if these are missing.
  WhitenedFit missing(const std::vector<EffectEntry>& effects, double size) const {
    Eigen::VectorXd lines = noise_of(arm, 41);
    for (const EffectEntry& entry : effects)
      lines += motion_of_size(arm, library_regressor(arm, entry), size);
    return leaving(arm, lines);
  }
  std::optional<Explanation> better(const WhitenedFit& s, const std::string& chosen) const {
    return better_explanation(s, scan(s, not_testable, {}), chosen, not_testable, {});
  }
  std::string key(const EffectEntry& entry) const { return key_of(*arm.cell, entry); }

  const WhitenedFit& arm = whitened_arm().whitened;
  std::vector<std::string> not_testable;
  EffectEntry gear = entry_of("gear_harmonics", {1}), sag = entry_of("tool_sag");
};

TEST_F(Rivals, TheEffectThatIsThereIsNeverReplaced) {
  for (const EffectEntry& entry : {gear, sag, entry_of("base_compliance")})
    EXPECT_FALSE(better(missing({entry}, 5.0), key(entry))) << entry.name;
}

TEST_F(Rivals, OneThatIsNotThereMakesWayForTheOneThatIs) {
  const auto found = better(missing({gear}, 5.0), key(entry_of("gear_harmonics", {3})));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->effects.front().entry.name, gear.name);
}

/// Whatever is returned neither names what it replaces nor leaves more than noise, and its score is
/// the sum of those of its effects.
TEST_F(Rivals, ABetterExplanationKeepsItsPromises) {
  const WhitenedFit s = missing({gear, sag}, 4.0);
  const Scan look = scan(s, not_testable, {});
  for (std::size_t i = 0; i < std::min<std::size_t>(look.library.size(), 4); ++i) {
    const std::string chosen = key(look.library[i].entry);
    const auto found = better_explanation(s, look, chosen, not_testable, {});
    if (!found) continue;
    EXPECT_LE(found->times_noise, at_noise(s));
    double sum = 0.0;
    for (const Found& effect : found->effects) {
      EXPECT_NE(key(effect.entry), chosen);
      sum += effect.score;
    }
    EXPECT_NEAR(found->score, sum, 1e-9 * std::abs(sum));
    EXPECT_LE(found->effects.size(), static_cast<std::size_t>(kLongestExplanation));
  }
}

TEST_F(Rivals, ThereIsNoneOfSomethingThatTheScanDoesNotList) {
  const WhitenedFit s = missing({gear}, 5.0);
  EXPECT_FALSE(better(s, "no_such_effect:J1"));
  EXPECT_FALSE(better_explanation(s, {}, key(gear), not_testable, {})) << "nothing is listed";
}

TEST_F(Rivals, WhereOnlyNoiseIsLeftNothingIsBetter) {
  const WhitenedFit s = missing({}, 0.0);
  for (const EffectEntry& entry : {gear, sag}) EXPECT_FALSE(better(s, key(entry)));
}

TEST_F(Rivals, AnExplanationThatLeavesMoreThanNoiseReplacesNothing) {
  // Structure that none of the laws explains.
  WhitenedFit s = missing({gear}, 5.0);
  const Regressor other = library_regressor(arm, entry_of("reversal", {2}));
  s = leaving(arm, s.y + motion_of_size(arm, other, 5.0));
  EXPECT_FALSE(better(s, key(entry_of("gear_harmonics", {3}))));
}

}  // namespace
}  // namespace plumb::offline
