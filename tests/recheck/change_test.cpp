// SPDX-License-Identifier: Apache-2.0
#include "recheck/change.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "recheck/constants.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

struct RecheckChange : testing::Test {
  RecheckChange() {
    arm.cell.mechanics[1].link_mass_kg = 8.0;
    arm.cell.mechanics[1].link_com_m = {{0.2, 0.0, 0.0}};
    arm.state.arm.mechanics = mechanics_of(arm.cell);
    own = arm.poses(25, 9);
    own.context.direction = RowsN::Ones(25, 3);
    own.context.direction.topRows(12) *= -1.0;
    extended = with_room_for_changes(arm.cell, own, own, arm.state);
  }
  std::vector<Change> possible(int readings) const {
    return possible_changes(arm.cell, extended, own, readings);
  }

  SmallArm arm;
  Measurements own;
  ArmState extended;
};

TEST_F(RecheckChange, RoomForChangesMovesNoPoint) {
  EXPECT_GT(extended.arm.effects.size(), 0U);
  EXPECT_EQ(predict_points(extended, own), predict_points(arm.state, own));
  EXPECT_EQ(with_room_for_changes(arm.cell, own, own, extended).arm.effects.size(),
            extended.arm.effects.size());
}

TEST_F(RecheckChange, TheChancesOfAllAndOfSingleReadingsAddUpToOne) {
  for (const int readings : {1, 3, 4, 12}) {
    double sum = 0.0;
    for (const Change& change : possible(readings)) sum += change.chance;
    if (readings >= kFewestForOddOnes)
      for (int i = 0; i < readings; ++i) sum += odd_reading(i, readings, 1e-5).chance;
    EXPECT_NEAR(sum, 1.0, 1e-12) << readings;
  }
}

TEST_F(RecheckChange, EveryChangeMovesThePointAndNoTwoAreTheSame) {
  const std::vector<Change> all = possible(12);
  for (std::size_t a = 0; a < all.size(); ++a) {
    EXPECT_GT(slopes(own, extended, all[a].parameters).cwiseAbs().maxCoeff(), 1e-9)
        << words_of(all[a], arm.cell);
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_FALSE(same(all[a], all[b]));
      EXPECT_NE(words_of(all[a], arm.cell), words_of(all[b], arm.cell));
    }
  }
}

/// Stiffness shows where a mass is carried: joint 3 carries none.
TEST_F(RecheckChange, TheStiffnessOfAJointWithoutLoadIsNoPossibleChange) {
  const auto springs = [&](int joint) {
    const auto all = possible(12);
    return std::count_if(all.begin(), all.end(), [&](const Change& c) {
      return c.effect == "joint_compliance" && c.joint == joint;
    });
  };
  EXPECT_EQ(springs(1), 1);
  EXPECT_EQ(springs(2), 0);
}

TEST_F(RecheckChange, AUsualChangeOfAnEffectMovesThePointByATenthOfAMillimetre) {
  int effects = 0;
  for (const Change& change : possible(12)) {
    if (change.effect != "joint_compliance" && change.effect != "reversal") continue;
    ++effects;
    const Eigen::MatrixXd motion = slopes(own, extended, change.parameters);
    for (Eigen::Index k = 0; k < motion.cols(); ++k) {
      const double rms = change.typical(k) * motion.col(k).norm() / std::sqrt(25.0);
      EXPECT_NEAR(rms, kEffect_m, 1e-3 * kEffect_m) << words_of(change, arm.cell);
    }
  }
  EXPECT_GE(effects, 4);
}

TEST_F(RecheckChange, DerivativesAreSlopesOfThePredictedPoints) {
  own.has_axis[1] = false;
  for (const Change& change : possible(12)) {
    const Eigen::MatrixXd expected = slopes(own, extended, change.parameters);
    EXPECT_LT((derivatives(own, extended, change.parameters) - expected).norm(),
              1e-6 * expected.norm())
        << words_of(change, arm.cell);
  }
}

}  // namespace
}  // namespace plumb::offline::recheck
