// SPDX-License-Identifier: Apache-2.0
// An effect of a size that hardly any arm has: what it is, and what stands behind it.
#include "diagnose/behind_oversized.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/constants.hpp"
#include "tests/diagnose/begun.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

struct BehindOversized : testing::Test {
  static BlindCase hiding_one(const std::string& effect) {
    BlindRequest request;
    request.poses = 80;
    request.fresh_poses = 1;
    request.repeats = 1;
    if (!effect.empty()) request.effects = {effect};
    return make_blind_case(request);
  }
  static BlindCase worn_gear() {
    BlindCase out = healthy_arm(80);
    make_uneven(out, 1, 4e-3);
    return out;
  }
  static EffectEntry yielding_joint() { return entry_of("joint_compliance", {1}); }
};

TEST_F(BehindOversized, AnEffectOfAUsualSizeIsNeverUnlikely) {
  const BlindCase blind = hiding_one("joint_compliance:J2:5");
  Selection s = having_added(blind, {yielding_joint()});
  std::vector<Oversized> unlikely;
  EXPECT_FALSE(behind_oversized(s, unlikely));
  EXPECT_TRUE(unlikely.empty());
}

/// A worn gear is a gear.
TEST_F(BehindOversized, AnEffectThatIsOnlyLargeIsItselfAndSaid) {
  const BlindCase blind = worn_gear();
  Selection s = having_added(blind, {entry_of("gear_harmonics", {1})});
  std::vector<Oversized> unlikely;
  EXPECT_FALSE(behind_oversized(s, unlikely));
  ASSERT_EQ(unlikely.size(), 1U);
  EXPECT_EQ(unlikely.front().entry.name, "gear_harmonics");
  EXPECT_TRUE(unlikely.front().possible);
  EXPECT_GT(unlikely.front().times, kMostTimesUsual);
  EXPECT_EQ(keys_in(s), std::vector<std::string>{"gear_harmonics:J2"}) << "it stays in the model";
}

/// A joint that gravity lifts: its compliance comes out negative, which no spring has.
TEST_F(BehindOversized, BehindASizeThatItsLawRulesOutThereIsSomethingElse) {
  const BlindCase yields = hiding_one("joint_compliance:J2:30");
  BlindCase blind = hiding_one("");
  ASSERT_EQ(yields.measured.measured.p_M.rows(), blind.measured.measured.p_M.rows());
  blind.measured.measured.p_M += blind.measured.measured.p_M - yields.measured.measured.p_M;
  Selection s = having_added(blind, {yielding_joint()});
  std::vector<Oversized> unlikely;
  const auto unknown = behind_oversized(s, unlikely);
  ASSERT_TRUE(unknown);
  ASSERT_TRUE(unknown->instead);
  EXPECT_EQ(unknown->instead->entry.name, "joint_compliance");
  EXPECT_FALSE(unknown->instead->possible);
  const auto& inputs = unknown->pattern.depends_on;
  EXPECT_EQ(std::count(inputs.begin(), inputs.end(), "q2"), 1) << "of the joint that it was named";
  EXPECT_TRUE(unlikely.empty());
  EXPECT_EQ(keys_in(s), std::vector<std::string>{"joint_compliance:J2"})
      << "by looking nothing changes";
}

/// The cell gives it, so it is what the user says it is.
TEST_F(BehindOversized, AnEffectThatTheUserGaveIsNotDoubted) {
  const BlindCase blind = worn_gear();
  Cell cell = blind.cell;
  cell.effects.push_back(entry_of("gear_harmonics", {1}));
  Selection s = begun(blind, cell);
  std::vector<Oversized> unlikely;
  EXPECT_FALSE(behind_oversized(s, unlikely));
  EXPECT_TRUE(unlikely.empty());
}

}  // namespace
}  // namespace plumb::offline
