// SPDX-License-Identifier: Apache-2.0
#include "recheck/recheck.hpp"

#include <gtest/gtest.h>

#include <set>

#include "arm/arm_change.hpp"
#include "arm/predicted_points.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kSigma_m = 2e-5;

/// Forty poses of a calibration, and ten of them measured again.
struct Rechecked : testing::Test {
  Rechecked() {
    own = arm.poses(40, 51);
    tests::Random random(52);
    add_noise(own, kSigma_m, random);
    run = arm.run(own);
    run.fit.floor.source = NoiseFloor::Source::kRepeats;
    run.fit.floor.sigma_m = kSigma_m;
  }
  Measurements again(const ArmState& now) const {
    Measurements rows = pick(own, {0, 3, 7, 11, 15, 19, 23, 27, 31, 35});
    rows.p_M = predict_points(now, rows);
    tests::Random random(53);
    add_noise(rows, kSigma_m, random);
    return rows;
  }
  Recheck recheck(const ArmState& now, const Assumed& assumed = {}) const {
    return recheck_run(arm.cell, run, run, own, again(now), assumed);
  }

  SmallArm arm;
  Measurements own;
  offline::Run run;
};

TEST_F(Rechecked, AnArmThatStayedAsItWasIsTrue) {
  const Recheck out = recheck(arm.state);
  EXPECT_TRUE(out.found.empty());
  EXPECT_FALSE(out.something_else);
  EXPECT_NE(out.verdict, Recheck::Verdict::kChanged);
  EXPECT_LT(out.before.mean, out.control_m);
}

/// What is found makes the refitted state predict the true points.
TEST_F(Rechecked, AMovedReflectorIsTheChangeAndIsRefitted) {
  ArmState now = arm.state;
  now.X_TG.p[0] += 6e-4, now.X_TG.p[2] -= 4e-4;
  const Recheck out = recheck(now);
  EXPECT_EQ(out.verdict, Recheck::Verdict::kChanged);
  ASSERT_EQ(out.found.size(), 1U);
  EXPECT_EQ(out.found[0].change.part, Part::kTool);
  const Rows3 missed = predict_points(out.calibration.state, own) - predict_points(now, own);
  EXPECT_LT(missed.rowwise().norm().maxCoeff(), 2.0 * kSigma_m);
  EXPECT_LT(out.after.mean, out.control_m);
  EXPECT_GT(out.before.mean, out.control_m);
}

TEST_F(Rechecked, ANewPlaceOfTheTrackerThatWasAssumedIsNoChange) {
  ArmState now = arm.state;
  now.X_MB = {{-4.0, 1.0, 0.3}, {0.5, -0.5, 0.5, 0.5}};
  const Recheck out = recheck(now, {.new_frame = true, .new_target = false});
  EXPECT_TRUE(out.found.empty());
  EXPECT_LT(out.before.mean, 3.0 * out.expected_m);
  const Rows3 missed = predict_points(out.calibration.state, own) - predict_points(now, own);
  EXPECT_LT(missed.rowwise().norm().maxCoeff(), 5.0 * kSigma_m);
}

/// Scattered readings are missed by more than any change of one part explains.
TEST_F(Rechecked, ErrorsThatNoPartExplainsAreSomethingElse) {
  Measurements rows = again(arm.state);
  tests::Random random(54);
  add_noise(rows, 20.0 * kSigma_m, random);
  const Recheck out = recheck_run(arm.cell, run, run, own, rows, {});
  EXPECT_TRUE(out.something_else);
  EXPECT_NE(out.verdict, Recheck::Verdict::kTrue);
}

TEST_F(Rechecked, OfManyReadingsAsManyAsAreJudgedAreSpreadEvenly) {
  for (const int size : {1, 40, 100, 101, 250, 100000}) {
    const std::vector<int> rows = judged_rows(size);
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(std::min(size, 100)));
    EXPECT_EQ(std::set<int>(rows.begin(), rows.end()).size(), rows.size());
    for (std::size_t k = 1; k < rows.size(); ++k)
      EXPECT_LE(std::abs(rows[k] - rows[k - 1] - size / static_cast<double>(rows.size())), 1.0);
    EXPECT_LT(rows.back(), size);
  }
}

}  // namespace
}  // namespace plumb::offline::recheck
