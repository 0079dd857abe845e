// SPDX-License-Identifier: Apache-2.0
// The first or the last poses of a series disagree with the rest.
#include "diagnose/left_out_ends.hpp"

#include <gtest/gtest.h>

#include <set>

#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/begun.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr int kSeries = 90;

/// The reflector is elsewhere at these rows, by two hundred times the noise.
void bump(BlindCase& blind, int begin, int end) {
  for (int i = begin; i < end; ++i)
    blind.measured.measured.p_M.row(i) += Eigen::RowVector3d(3e-3, -2e-3, 2e-3);
}

std::set<int> left_out(const Selection& s) {
  std::set<int> out;
  for (const Outlier& outlier : s.calibration().outliers) out.insert(static_cast<int>(outlier.row));
  return out;
}

bool holds_any(const std::set<int>& rows, int begin, int end) {
  return rows.lower_bound(begin) != rows.lower_bound(end);
}

TEST(LeftOutEnds, OfOneMoveAreExplainedByAStepThereAndCountAgain) {
  for (const bool at_begin : {true, false}) {
    const int begin = at_begin ? 0 : kSeries - 7, end = at_begin ? 7 : kSeries;
    BlindCase blind = healthy_arm(kSeries, 3);
    bump(blind, begin, end);
    Selection s = begun(blind);
    ASSERT_TRUE(holds_any(left_out(s), begin, end)) << "they contradict the others";
    ASSERT_TRUE(revise(s, kLeftOutEnds));
    EXPECT_FALSE(holds_any(left_out(s), begin, end));
    ASSERT_EQ(keys_in(s).size(), 1U);
    const EffectEntry& step = s.cell().effects.back();
    EXPECT_TRUE(is_change_point(step.name));
    EXPECT_NEAR(number_option(step, OptionKey::kAfterRow, 0.0), at_begin ? end : begin, 1.0);
    EXPECT_EQ(keys_in(s), keys_added(s));
    EXPECT_FALSE(revise(s, kLeftOutEnds)) << "once is enough";
  }
}

TEST(LeftOutEnds, WhatWasLeftOutInTheMiddleOrShortlyIsNoEnd) {
  for (const auto& [begin, end] : {std::pair{40, 47}, std::pair{0, 2}, std::pair{88, 90}}) {
    BlindCase blind = healthy_arm(kSeries, 3);
    bump(blind, begin, end);
    Selection s = begun(blind);
    const auto before = left_out(s);
    ASSERT_TRUE(holds_any(before, begin, end));
    EXPECT_FALSE(revise(s, kLeftOutEnds)) << begin;
    EXPECT_EQ(left_out(s), before);
    EXPECT_TRUE(s.added.empty());
  }
}

/// Poses that contradict each other too are no set-up that stood elsewhere.
TEST(LeftOutEnds, ThatAgreeWithNothingStayOut) {
  BlindCase blind = healthy_arm(kSeries, 3);
  tests::Random random(9);
  for (int i = 0; i < 7; ++i)
    for (int axis = 0; axis < 3; ++axis)
      blind.measured.measured.p_M(i, axis) += random.uniform(-5e-3, 5e-3);
  Selection s = begun(blind);
  const auto before = left_out(s);
  ASSERT_GE(before.size(), 5U);
  EXPECT_FALSE(revise(s, kLeftOutEnds));
  EXPECT_EQ(left_out(s), before);
  EXPECT_TRUE(keys_in(s).empty());
}

}  // namespace
}  // namespace plumb::offline
