// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "fleet/effect_shares.hpp"

namespace {

using plumb::offline::fleet::CellSummary;
using plumb::offline::fleet::EffectShares;
using plumb::offline::fleet::learn_shares;

/// Arms whose Bayes factors of two effects are given.
CellSummary arm(double ln_spring, double ln_gear) {
  CellSummary out;
  out.ok = true;
  out.diagnosis = {.finding = "missing",
                   .effect = "",
                   .joints = {},
                   .words = "",
                   .evidence = {{"spring", ln_spring}, {"gear", ln_gear}}};
  return out;
}

EffectShares shares_of(const std::vector<CellSummary>& arms) {
  std::vector<const CellSummary*> pointers;
  for (const auto& one : arms) pointers.push_back(&one);
  return learn_shares(pointers);
}

TEST(EffectShares, OfAnEffectThatAllArmsShowSpeakForIt) {
  const auto shares = shares_of(std::vector(60, arm(40.0, -3.0)));
  EXPECT_EQ(shares.diagnosed, 60);
  ASSERT_EQ(shares.effects.size(), 2U);  // by name
  EXPECT_NEAR(shares.effects[1].arms, 60.0, 1e-6);
  // By hand: ln(60.5 / 10) - ln(0.5 / 10), and for the other one ln(0.5 / 10) - ln(0.5 / 10).
  EXPECT_NEAR(shares.effects[1].odds_nats, std::log(121.0), 1e-6);
  EXPECT_NEAR(shares.effects[0].odds_nats, 0.0, 1e-3);
}

TEST(EffectShares, OfAnEffectThatNoArmShowsSpeakAgainstIt) {
  const auto shares = shares_of(std::vector(60, arm(-5.0, -3.0)));
  for (const auto& one : shares.effects) {
    EXPECT_LT(one.arms, 0.5);
    EXPECT_LT(one.odds_nats, -1.5);
  }
}

TEST(EffectShares, ATieIsDecidedByTheSistersThatAreClear) {
  std::vector<CellSummary> arms(30, arm(40.0, 0.0));
  arms.resize(60, arm(20.0, 20.0));
  const auto shares = shares_of(arms);
  EXPECT_GT(shares.effects[1].arms, 58.0);
  EXPECT_LT(shares.effects[0].arms, 2.0);
}

TEST(EffectShares, FewerThanFiveArmsTeachNothing) {
  EXPECT_TRUE(shares_of(std::vector(4, arm(40.0, 0.0))).effects.empty());
  EXPECT_FALSE(shares_of(std::vector(5, arm(40.0, 0.0))).effects.empty());
}

}  // namespace
