// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "fleet/effect_shares.hpp"

namespace {

using plumb::offline::fleet::CellSummary;
using plumb::offline::fleet::EffectShare;
using plumb::offline::fleet::learn_shares;

const char* const kSpring = "joint_compliance";
const char* const kGear = "gear_harmonics";

/// An arm with only its geometry fitted, and the Bayes factors of two effects.
CellSummary diagnosed(double ln_spring, double ln_gear) {
  CellSummary out;
  out.ok = true;
  out.effects = {"geometry"};
  out.diagnosis.emplace();
  out.diagnosis->evidence = {{kSpring, ln_spring}, {kGear, ln_gear}};
  return out;
}

CellSummary with_effects(std::vector<std::string> effects) {
  CellSummary out;
  out.ok = true;
  out.effects = std::move(effects);
  return out;
}

std::vector<EffectShare> shares_of(const std::vector<CellSummary>& arms) {
  std::vector<const CellSummary*> pointers;
  for (const auto& one : arms) pointers.push_back(&one);
  return learn_shares(pointers);
}

EffectShare share_of(const std::vector<CellSummary>& arms, const std::string& effect) {
  for (const auto& one : shares_of(arms))
    if (one.effect == effect) return one;
  ADD_FAILURE() << "nothing is known of " << effect;
  return {};
}

TEST(EffectShares, OfWhatEveryModelHolds) {
  const std::vector arms(60, with_effects({"geometry", kSpring}));
  EXPECT_DOUBLE_EQ(share_of(arms, kSpring).arms, 60.0);
  // By hand: ln(60.5 / 10) - ln(0.5 / 10).
  EXPECT_NEAR(share_of(arms, kSpring).odds_nats, std::log(121.0), 1e-9);
}

TEST(EffectShares, OfWhatAllDiagnosesSpeakFor) {
  const std::vector arms(60, diagnosed(40.0, -3.0));
  EXPECT_NEAR(share_of(arms, kSpring).arms, 60.0, 1e-6);
  EXPECT_NEAR(share_of(arms, kGear).arms, 0.0, 1e-6);
  EXPECT_NEAR(share_of(arms, kGear).odds_nats, std::log(0.5 / 70.0) - std::log(0.5 / 10.0), 1e-6);
}

TEST(EffectShares, ATieIsDecidedByTheSistersThatAreClear) {
  std::vector<CellSummary> arms(30, diagnosed(40.0, 0.0));
  arms.resize(60, diagnosed(20.0, 20.0));
  EXPECT_GT(share_of(arms, kSpring).arms, 58.0);
  EXPECT_LT(share_of(arms, kGear).arms, 2.0);
}

TEST(EffectShares, AModelOfTheGeometryAloneTellsNothing) {
  std::vector<CellSummary> arms(6, with_effects({"geometry", kSpring}));
  arms.resize(60, with_effects({"geometry"}));
  EXPECT_DOUBLE_EQ(share_of(arms, kSpring).of, 6.0);
  arms.resize(66, with_effects({"geometry", kGear}));
  EXPECT_DOUBLE_EQ(share_of(arms, kSpring).of, 12.0) << "somebody looked for effects there";
  EXPECT_DOUBLE_EQ(share_of(arms, kSpring).arms, 6.0);
}

TEST(EffectShares, WhatHappensWhileMeasuringIsNotShared) {
  EXPECT_TRUE(shares_of(std::vector(9, with_effects({"geometry", "drift"}))).empty());
}

TEST(EffectShares, FewerThanFiveArmsTeachNothing) {
  EXPECT_TRUE(shares_of(std::vector(4, diagnosed(40.0, 0.0))).empty());
  EXPECT_FALSE(shares_of(std::vector(5, diagnosed(40.0, 0.0))).empty());
}

}  // namespace
