// SPDX-License-Identifier: Apache-2.0
#include "recheck/left_out.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "arm/predicted_points.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kSigma_m = 3e-5;

/// Eight readings after a moved tool, whose noise is correlated.
struct LeftOut : testing::Test {
  LeftOut() {
    Measurements rows = arm.poses(8, 31);
    ArmState now = arm.state;
    now.X_TG.p[0] += 4e-4;
    rows.p_M = predict_points(now, rows);
    tests::Random random(4);
    add_noise(rows, kSigma_m, random);
    readings = readings_of(std::move(rows), kSigma_m);
    readings.expected[0].covariance = correlated(readings.lines(), kSigma_m * kSigma_m, random);
  }
  Readings without(int reading) const {
    std::vector<int> rows;
    std::vector<Eigen::Index> lines;
    for (int i = 0; i < readings.rows.size(); ++i) {
      if (i == reading) continue;
      rows.push_back(i);
      for (int k = 0; k < 3; ++k) lines.push_back(3 * i + k);
    }
    Readings out = readings_of(pick(readings.rows, rows), kSigma_m);
    out.expected[0].covariance = readings.expected[0].covariance(lines, lines);
    return out;
  }

  SmallArm arm;
  KnownNumbers known;  // none: the arm is known exactly
  Readings readings;
};

TEST_F(LeftOut, IsTheErrorOfARefitThatNeverSawTheReading) {
  const std::vector<Change> changes = {arm.tool()};
  const Judged judged = Judge(readings, arm.state, known).judge(changes);
  const Rows3 errors = left_out_errors(readings, changes, judged);
  for (int i = 0; i < readings.rows.size(); ++i) {
    const Readings others = without(i);
    const ArmState refit = Judge(others, arm.state, known).judge(changes).state;
    const Measurements one = pick(readings.rows, {i});
    const Rows3 expected = one.p_M - predict_points(refit, one);
    EXPECT_LT((errors.row(i) - expected.row(0)).norm(), 1e-9) << i;
  }
}

TEST_F(LeftOut, AReadingThatIsWrongIsShownWithItsWholeError) {
  readings.rows.p_M(3, 1) += 5e-3;
  const std::vector<Change> changes = {arm.tool(), odd_reading(3, 8, kSigma_m)};
  const Judged judged = Judge(readings, arm.state, known).judge(changes);
  const Rows3 errors = left_out_errors(readings, changes, judged);
  EXPECT_NEAR(errors(3, 1), 5e-3, 5.0 * kSigma_m);
  EXPECT_LT(stats_of(errors, {3}).max, 10.0 * kSigma_m);
  EXPECT_EQ(stats_of(errors, {3}).n, 7);
}

TEST_F(LeftOut, AnAxisThatWasNotMeasuredHasNoError) {
  readings.rows.has_axis[1] = false;
  readings.axes = 2;
  const Eigen::VectorXd lines = Eigen::VectorXd::LinSpaced(16, 1.0, 16.0);
  const Rows3 errors = errors_of(readings, lines);
  EXPECT_EQ(errors.col(1).norm(), 0.0);
  for (Eigen::Index i = 0; i < 8; ++i) {
    EXPECT_EQ(errors(i, 0), lines(2 * i));
    EXPECT_EQ(errors(i, 2), lines(2 * i + 1));
  }
}

}  // namespace
}  // namespace plumb::offline::recheck
