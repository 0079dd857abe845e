// SPDX-License-Identifier: Apache-2.0
#include "recheck/refit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/predicted_points.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kSigma_m = 3e-5;

struct RecheckRefit : testing::Test {
  Calibration refit(const LastSetup& before, const Readings& readings,
                    const std::vector<Change>& changes) const {
    const Judged judged = Judge(readings, before.state, before.known).judge(changes);
    return refitted(arm.cell, arm.run(readings.rows).fit.calibration, before, changes, judged);
  }
  Change wide(Change change) const {
    change.scales = {100.0};
    return change;
  }

  SmallArm arm;
};

TEST_F(RecheckRefit, OfAnExactlyKnownArmHasTheCovarianceOfLeastSquares) {
  const Readings readings = readings_of(arm.poses(9, 15), kSigma_m);
  const LastSetup before{arm.state, arm.known(0.0)};
  const Change tool = wide(arm.tool());
  const Calibration out = refit(before, readings, {tool});
  const Eigen::MatrixXd B = slopes(readings.rows, arm.state, tool.parameters);
  const Eigen::MatrixXd expected = kSigma_m * kSigma_m * (B.transpose() * B).inverse();
  ASSERT_EQ(out.parameters.size(), 5U);
  EXPECT_LT((out.covariance.bottomRightCorner(3, 3) - expected).norm(), 1e-5 * expected.norm());
  EXPECT_EQ(out.covariance.topRows(2).norm(), 0.0);
}

/// The truth is drawn with the errors that the run admits, then J2 is turned and the tool moved:
/// the mean of (estimate - truth)^T C^-1 (estimate - truth) is the count of the numbers.
TEST_F(RecheckRefit, ItsCovarianceIsThatOfItsErrorsOverManyRechecks) {
  const LastSetup before{arm.state, arm.known(3e-4)};
  const std::vector<Change> changes = {wide(arm.tool()), wide(arm.offset(1))};
  const Eigen::MatrixXd L = before.known.covariance.llt().matrixL();
  tests::Random random(16);
  constexpr int kDraws = 200;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd e(2);
    for (double& one : e) one = normal(random);
    ArmState truth = moved(arm.state, before.known.parameters, L * e);
    truth = moved(truth, changes[1].parameters, Eigen::VectorXd::Constant(1, 2e-3));
    truth.X_TG.p[1] += 1e-3;
    Measurements rows = arm.poses(6, 17);
    rows.p_M = predict_points(truth, rows);
    add_noise(rows, kSigma_m, random);
    const Calibration out = refit(before, readings_of(std::move(rows), kSigma_m), changes);
    ASSERT_EQ(out.parameters.size(), 5U);
    Eigen::VectorXd error(5);
    for (int k = 0; k < 5; ++k) {
      const Parameter& p = out.parameters[static_cast<std::size_t>(k)];
      error(k) = value_of(out.state, p) - value_of(truth, p);
    }
    sum += error.dot(out.covariance.inverse() * error);
  }
  EXPECT_NEAR(sum / kDraws, 5.0, 4.0 * std::sqrt(10.0 / kDraws));
}

TEST_F(RecheckRefit, NumbersThatDidNotChangeStay) {
  Measurements rows = arm.poses(9, 18);
  ArmState now = arm.state;
  now.X_TG.p[0] += 1e-3;
  rows.p_M = predict_points(now, rows);
  const LastSetup before{arm.state, arm.known(1e-4)};
  const Calibration out = refit(before, readings_of(std::move(rows), kSigma_m), {arm.tool()});
  EXPECT_EQ(out.state.arm.calibrated, arm.state.arm.calibrated);
  const Eigen::MatrixXd kept = out.covariance.topLeftCorner(2, 2);
  EXPECT_LT((kept - before.known.covariance).norm(), 1e-12 * kept.norm());
}

TEST_F(RecheckRefit, EffectsThatWereOnlyAskedForAreLeftOut) {
  arm.cell.mechanics[1].link_mass_kg = 8.0;
  const Measurements own = arm.poses(9, 19);
  const LastSetup run{arm.state, arm.known(1e-4)};
  const ArmState extended = with_room_for_changes(arm.cell, own, own, arm.state);
  const Readings readings = readings_of(own, kSigma_m);
  const std::vector<Change> changes = {arm.tool()};
  const Judged judged = Judge(readings, extended, run.known).judge(changes);
  const Calibration out = refitted(arm.cell, arm.run(own).fit.calibration, run, changes, judged);
  EXPECT_GT(judged.state.arm.effects.size(), 0U);
  EXPECT_EQ(out.state.arm.effects.size(), 0U);
}

/// Frame and target of the last of two set-ups are those of the readings, by the names of one.
TEST_F(RecheckRefit, TheLastSetupIsTheRunInThatSetupAlone) {
  offline::Run run = arm.run(arm.poses(9, 20));
  Calibration& c = run.fit.calibration;
  const format::Pose second{{3.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  c.state.more.push_back({.frame_of = 1, .target_of = 0, .X_MB = second, .X_TG = {}});
  for (const int setup : {0, 1}) {
    Parameter p = *placing_parameter("frame.x");
    p.setup = setup;
    p.name = setup == 0 ? "frame[one].x" : "frame[two].x";
    c.parameters.push_back(p);
    c.estimates.emplace_back();
  }
  c.covariance = Eigen::Vector4d(1.0, 2.0, 3.0, 4.0).asDiagonal();
  const LastSetup last = last_setup(run);
  EXPECT_EQ(last.state.setups(), 1);
  EXPECT_EQ(last.state.X_MB, second);
  EXPECT_EQ(last.state.X_TG, arm.state.X_TG);
  ASSERT_EQ(last.known.parameters.size(), 3U);
  EXPECT_EQ(last.known.parameters[2].name, "frame.x");
  EXPECT_EQ(last.known.parameters[2].setup, 0);
  EXPECT_EQ(last.known.covariance(2, 2), 4.0);
}

}  // namespace
}  // namespace plumb::offline::recheck
