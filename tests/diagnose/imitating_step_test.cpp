// SPDX-License-Identifier: Apache-2.0
// A joint that creeps with the temperature of its drive, and one whose encoder slipped.
#include "diagnose/imitating_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/begun.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

struct ImitatingSteps : testing::Test {
  static constexpr int kJoint = 3, kPoses = 80;

  /// The zero of the joint moves by this function of the place in the series, from 0 to 1.
  static BlindCase moving(double (*by)(double)) {
    BlindCase out = healthy_arm(kPoses);
    Measurements& m = out.measured.measured;
    for (Eigen::Index i = 0; i < m.q.rows(); ++i)
      m.q(i, kJoint) -= 4e-4 * by(static_cast<double>(i) / static_cast<double>(m.q.rows()));
    return out;
  }
  static double swings(double at) { return std::sin(3.0 * M_PI * at); }
  static double slips(double at) { return at < 0.5 ? 0.0 : 1.0; }

  static EffectEntry slip_at(double row) {
    EffectEntry out = entry_of(change_point_effect(), {kJoint});
    set_option(out, OptionKey::kOf, std::string("joint"));
    set_option(out, OptionKey::kAfterRow, row);
    return out;
  }
};

TEST_F(ImitatingSteps, AStepOfAJointThatSwingsIsTakenOutForGood) {
  const BlindCase blind = moving(swings);
  Selection s = having_added(blind, {slip_at(27)});
  const std::string key = s.key(slip_at(27));
  const double left = s.whitened().Q;
  ASSERT_TRUE(revise(s, kImitatingStep));
  EXPECT_TRUE(keys_in(s).empty());
  EXPECT_TRUE(s.added.empty());
  EXPECT_GT(s.whitened().Q, left) << "the pattern is not in the model, but what is left to explain";
  ASSERT_TRUE(s.look().pattern);
  EXPECT_EQ(std::count(s.banned().begin(), s.banned().end(), key), 1);
  EXPECT_EQ(s.look().find(s.cell(), key), nullptr) << "it is not looked for again";
}

TEST_F(ImitatingSteps, AnEncoderThatSlippedStaysInTheModel) {
  const BlindCase blind = moving(slips);
  Selection s = having_added(blind, {slip_at(40)});
  EXPECT_FALSE(revise(s, kImitatingStep));
  EXPECT_EQ(keys_in(s).size(), 1U);
  EXPECT_EQ(s.added.size(), 1U);
  EXPECT_TRUE(s.banned().empty());
}

TEST_F(ImitatingSteps, WhatIsNoStepOrWasGivenStays) {
  const BlindCase blind = moving(swings);
  Selection gear = having_added(blind, {entry_of("gear_harmonics", {kJoint})});
  EXPECT_FALSE(revise(gear, kImitatingStep));
  EXPECT_EQ(keys_in(gear).size(), 1U);
  Cell cell = blind.cell;
  cell.effects.push_back(slip_at(27));
  Selection given = begun(blind, cell);
  EXPECT_FALSE(revise(given, kImitatingStep));
  EXPECT_EQ(given.cell().effects.size(), cell.effects.size());
}

/// Structure at another joint says nothing against a step.
TEST_F(ImitatingSteps, AStepBesideAJointThatSwingsElsewhereStays) {
  BlindCase blind = moving(swings);
  Measurements& m = blind.measured.measured;
  for (Eigen::Index i = kPoses / 2; i < m.q.rows(); ++i) m.q(i, 1) -= 1e-4;
  EffectEntry slip = slip_at(40);
  slip.joints = {1};
  Selection s = having_added(blind, {slip});
  EXPECT_FALSE(revise(s, kImitatingStep));
  EXPECT_EQ(keys_in(s).size(), 1U);
}

}  // namespace
}  // namespace plumb::offline
