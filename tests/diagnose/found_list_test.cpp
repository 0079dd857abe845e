// SPDX-License-Identifier: Apache-2.0
#include "diagnose/found_list.hpp"

#include <gtest/gtest.h>

#include "diagnose/effect_list.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

Found found_of(EffectEntry entry) { return {std::move(entry), {}, {}, {}, 0.0, {}, 0.0}; }

Found waves(int joint, std::vector<double> cycles) {
  Found out = found_of(entry_of("gear_ripple", {joint}));
  out.cycles = std::move(cycles);
  return out;
}

Found moves(const std::vector<double>& after_rows) {
  Found out = found_of(entry_of("step"));
  set_option(out.entry, OptionKey::kOf, std::string("tool"));
  set_option(out.entry, OptionKey::kAfterRow, after_rows.front());
  for (const double row : after_rows) out.moves.push_back({row, 1e-4});
  return out;
}

std::vector<Found> some() {
  return {found_of(entry_of("joint_compliance", {1, 2, 4})), waves(3, {7.0, 11.0, 2.5}),
          moves({20.0, 45.0, 60.0}), found_of(entry_of("tool_sag"))};
}

std::vector<EffectEntry> entries_of(const std::vector<Found>& all) {
  std::vector<EffectEntry> out;
  for (const Found& found : all)
    for (const auto& entry : found.entries()) out.push_back(entry);
  return out;
}

TEST(FoundList, EveryWaveEveryMoveAndEveryOtherEffectIsAnEntry) {
  EXPECT_EQ(entries_of(some()).size(), 1U + 3U + 3U + 1U);
  for (const EffectEntry& entry : entries_of(some()))
    EXPECT_TRUE(has_effect(with_found({}, found_of(entry)), entry) || entry.name == "gear_ripple");
}

TEST(FoundList, AddedTwiceIsAddedOnce) {
  for (const Found& found : some()) {
    if (found.entry.name == "gear_ripple") continue;
    const auto once = with_found({}, found), twice = with_found(once, found);
    EXPECT_TRUE(taken_out(twice, once).empty()) << found.entry.name;
    EXPECT_TRUE(taken_out(once, twice).empty()) << found.entry.name;
  }
}

/// Whichever entry is forgotten, it and it alone is gone.
TEST(FoundList, ForgettingAnEntryLeavesAllOthers) {
  const auto before = entries_of(some());
  for (const EffectEntry& entry : before) {
    std::vector<Found> all = some();
    forget(all, entry);
    EXPECT_EQ(entries_of(all).size() + 1, before.size()) << entry.name;
    forget(all, entry);
    EXPECT_EQ(entries_of(all).size() + 1, before.size()) << "again: " << entry.name;
  }
}

TEST(FoundList, AJointOfSeveralGoesAlone) {
  std::vector<Found> all = some();
  forget(all, entry_of("joint_compliance", {2}));
  EXPECT_EQ(all[0].entry.joints, (std::vector<int>{1, 4}));
}

TEST(FoundList, OfTwoMovesOneIsAnOrdinaryStepAtItsPlace) {
  for (const double gone : {20.0, 45.0}) {
    std::vector<Found> all = {moves({20.0, 45.0})};
    EffectEntry entry = all[0].entry;
    set_option(entry, OptionKey::kAfterRow, gone);
    forget(all, entry);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_TRUE(all[0].moves.empty());
    EXPECT_EQ(number_option(all[0].entry, OptionKey::kAfterRow, 0.0), 65.0 - gone);
  }
}

TEST(FoundList, ForgettingEverythingInAnyOrderLeavesNothing) {
  tests::Random random(4);
  for (int round = 0; round < 20; ++round) {
    std::vector<Found> all = some();
    std::vector<EffectEntry> left = entries_of(all);
    while (!left.empty()) {
      const auto at = left.begin() + random.below(static_cast<int>(left.size()));
      forget(all, *at);
      left.erase(at);
    }
    EXPECT_TRUE(all.empty());
  }
}

TEST(FoundList, WhatIsNotThereIsNotForgotten) {
  std::vector<Found> all = some();
  const std::size_t before = entries_of(all).size();
  forget(all, entry_of("joint_compliance", {0}));
  forget(all, entry_of("base_compliance"));
  EffectEntry wave = entry_of("gear_ripple", {2});
  set_option(wave, OptionKey::kCyclesPerTurn, 7.0);
  forget(all, wave);
  EXPECT_EQ(entries_of(all).size(), before) << "a wave of another joint, too";
}

}  // namespace
}  // namespace plumb::offline
