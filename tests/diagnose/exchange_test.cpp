// SPDX-License-Identifier: Apache-2.0
// Effects that were chosen while others were missing, each taken out once and searched for again.
#include "diagnose/exchange.hpp"

#include <gtest/gtest.h>

#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/begun.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

/// The gears of the second and of the fourth joint are uneven.
struct Exchange : testing::Test {
  Exchange() {
    make_uneven(blind, 1, 3e-4);
    make_uneven(blind, 3, 3e-4);
  }
  BlindCase blind = healthy_arm(80);
  const EffectEntry second = entry_of("gear_harmonics", {1}),
                    fourth = entry_of("gear_harmonics", {3}),
                    imitates = entry_of("joint_compliance", {1});
};

TEST_F(Exchange, AnEffectThatOnlyImitatedAnotherMakesWayForIt) {
  Selection s = having_added(blind, {imitates, fourth});
  const double left = s.whitened().Q;
  ASSERT_TRUE(revise(s, kExchange));
  const auto keys = keys_in(s);
  EXPECT_EQ(std::count(keys.begin(), keys.end(), s.key(second)), 1);
  EXPECT_EQ(std::count(keys.begin(), keys.end(), s.key(imitates)), 0);
  EXPECT_EQ(std::count(keys.begin(), keys.end(), s.key(fourth)), 1) << "the other one stays";
  EXPECT_EQ(keys, keys_added(s));
  EXPECT_LT(s.whitened().Q, left);
}

TEST_F(Exchange, WhatIsThereIsKeptWhateverItsOrder) {
  for (const auto& effects : {std::vector{second, fourth}, std::vector{fourth, second}}) {
    Selection s = having_added(blind, effects);
    const auto before = keys_in(s);
    EXPECT_FALSE(revise(s, kExchange));
    EXPECT_EQ(keys_in(s), before);
    EXPECT_EQ(keys_added(s), before);
    for (const EffectEntry& entry : effects)
      EXPECT_FALSE(s.first_time(kExchange.name, s.key(entry))) << "it was tried";
  }
}

/// The one that was added last was chosen beside all others; if it is the only one there are none.
TEST_F(Exchange, ASingleEffectIsNotTakenOut) {
  Selection s = having_added(blind, {imitates});
  EXPECT_FALSE(revise(s, kExchange));
  EXPECT_TRUE(s.first_time(kExchange.name, s.key(imitates)));
}

TEST_F(Exchange, EachIsTriedOnceWavesNotAtAllAndAStepWheneverTheModelHasOtherEffects) {
  Selection s = having_added(blind, {second, fourth});
  const auto due = [&](const EffectEntry& entry) {
    Found found;
    found.entry = entry;
    return kExchange.due(s, kExchange.name, found);
  };
  EXPECT_TRUE(due(second));
  EXPECT_FALSE(due(second));
  EffectEntry wave = entry_of(wave_effect(), {2});
  set_option(wave, OptionKey::kCyclesPerTurn, 9.0);
  EXPECT_FALSE(due(wave));
  EXPECT_FALSE(due(entry_of(series_effect(), {2})));
  EffectEntry step = entry_of(change_point_effect());
  set_option(step, OptionKey::kOf, std::string("tool"));
  set_option(step, OptionKey::kAfterRow, 50.0);
  EXPECT_TRUE(due(step));
  EXPECT_FALSE(due(step));
  s.look_at(s.fitted({second}));
  EXPECT_TRUE(due(step)) << "another model";
  EXPECT_FALSE(due(step));
}

TEST_F(Exchange, ForItsSizeOnlyAnEffectOfAnUnusualOneIsTakenOut) {
  Selection usual = having_added(blind, {second, fourth});
  EXPECT_TRUE(kExchangeForSize.subjects(usual).empty());
  BlindCase worn = healthy_arm(80);
  make_uneven(worn, 1, 4e-3);
  Selection large = having_added(worn, {second});
  const auto subjects = kExchangeForSize.subjects(large);
  ASSERT_EQ(subjects.size(), 1U);
  EXPECT_EQ(large.key(subjects.front().entry), large.key(second));
  EXPECT_FALSE(revise(large, kExchangeForSize)) << "no other effect is near it";
  EXPECT_EQ(keys_in(large), std::vector<std::string>{large.key(second)});
}

}  // namespace
}  // namespace plumb::offline
