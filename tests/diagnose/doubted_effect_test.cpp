// SPDX-License-Identifier: Apache-2.0
// One wrong effect in the place of two right ones.
#include "diagnose/doubt.hpp"

#include <gtest/gtest.h>

#include "diagnose/constants.hpp"
#include "diagnose/evidence.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/begun.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

/// An arm of whose joints these have uneven gears.
BlindCase uneven_arm(const std::vector<Eigen::Index>& joints) {
  BlindCase out = healthy_arm(80);
  for (const Eigen::Index joint : joints) make_uneven(out, joint, 3e-4);
  return out;
}

EffectEntry gear_of(int joint) { return entry_of("gear_harmonics", {joint}); }

TEST(DoubtedEffect, WhereOnlyNoiseIsLeftNothingIsDoubted) {
  const BlindCase blind = uneven_arm({1});
  Selection s = having_added(blind, {gear_of(1)});
  EXPECT_TRUE(kDoubt.subjects(s).empty());
  EXPECT_FALSE(revise(s, kDoubt));
}

TEST(DoubtedEffect, TheStrongestIsAndOnlyThatOne) {
  const BlindCase blind = uneven_arm({0, 1, 3});
  Selection s = having_added(blind, {gear_of(1), gear_of(3)});
  for (const std::size_t strongest : {0, 1}) {
    s.added[strongest].scored.evidence.ln_bayes = 900.0;
    s.added[1 - strongest].scored.evidence.ln_bayes = 90.0;
    const auto subjects = kDoubt.subjects(s);
    ASSERT_EQ(subjects.size(), 1U);
    EXPECT_EQ(s.key(subjects.front().entry), s.key(s.added[strongest].entry));
  }
}

/// Waves have no rivals among laws, and are searched for again by themselves.
TEST(DoubtedEffect, AWaveIsNeverReplacedByLaws) {
  const BlindCase blind = uneven_arm({1});
  EffectEntry wave = entry_of(wave_effect(), {1});
  set_option(wave, OptionKey::kCyclesPerTurn, 3.0);
  Selection s = having_added(blind, {wave});
  ASSERT_NE(s.look().supported(), nullptr);
  EXPECT_TRUE(kDoubt.subjects(s).empty());
}

/// A right effect beside which another one is missing is not thrown away for it.
TEST(DoubtedEffect, ARightEffectStays) {
  const BlindCase blind = uneven_arm({1, 3});
  Selection s = having_added(blind, {gear_of(1)});
  ASSERT_EQ(kDoubt.subjects(s).size(), 1U);
  EXPECT_FALSE(revise(s, kDoubt));
  EXPECT_EQ(keys_in(s), std::vector<std::string>{s.key(gear_of(1))});
  EXPECT_EQ(keys_added(s), keys_in(s));
}

TEST(DoubtedEffect, OneThatStandsForTwoOthersIsReplacedByBoth) {
  const BlindCase blind = uneven_arm({1, 2});
  int replaced = 0;
  for (const EffectEntry& wrong :
       {entry_of("joint_compliance", {1}), entry_of("base_compliance")}) {
    Selection s = having_added(blind, {wrong});
    if (!revise(s, kDoubt)) continue;
    ++replaced;
    EXPECT_EQ(keys_added(s), keys_in(s)) << wrong.name;
    EXPECT_LE(times_noise(s.whitened()), kAboveNoise) << wrong.name;
    const auto keys = keys_in(s);
    EXPECT_EQ(keys, (std::vector<std::string>{"gear_harmonics:J2", "gear_harmonics:J3"}))
        << wrong.name;
    EXPECT_EQ(std::count(keys.begin(), keys.end(), s.key(wrong)), 0) << wrong.name;
  }
  EXPECT_GT(replaced, 0);
}

}  // namespace
}  // namespace plumb::offline
