// SPDX-License-Identifier: Apache-2.0
#include "recheck/readings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "arm/predicted_points.hpp"
#include "small_arm.hpp"
#include "solve/outliers.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kScatter_m = 1e-4;

/// A calibration whose model leaves a tenth of a millimetre.
struct RecheckReadings : testing::Test {
  RecheckReadings() {
    own = arm.poses(60, 25);
    tests::Random random(26);
    add_noise(own, kScatter_m, random);
    run = arm.run(own);
  }
  /// The scatter of a coordinate, with two numbers fitted.
  double scatter() const {
    return std::sqrt((own.p_M - predict_points(arm.state, own)).squaredNorm() / (60 * 3 - 2));
  }
  void floor_of(double sigma_m) {
    run.fit.floor.source = NoiseFloor::Source::kRepeats;
    run.fit.floor.sigma_m = sigma_m;
  }

  SmallArm arm;
  Measurements own;
  offline::Run run;
};

TEST_F(RecheckReadings, NoiseAndWhatTheModelLacksAreTheScatterTogether) {
  for (const double floor : {1e-5, 5e-5, 9e-5}) {
    floor_of(floor);
    const Readings out = expect_readings(arm.cell, run, own, arm.poses(5, 27));
    EXPECT_DOUBLE_EQ(out.noise_m, floor);
    EXPECT_NEAR(out.sigma_m(), scatter(), 1e-12);
    EXPECT_NEAR(expected_sigma(run, own), scatter(), 1e-12);
  }
}

TEST_F(RecheckReadings, NoiseIsNeverMoreThanTheScatterAndWithoutAFloorAllOfIt) {
  EXPECT_NEAR(expect_readings(arm.cell, run, own, arm.poses(5, 27)).noise_m, scatter(), 1e-12);
  floor_of(3.0 * kScatter_m);
  const Readings out = expect_readings(arm.cell, run, own, arm.poses(5, 27));
  EXPECT_NEAR(out.noise_m, scatter(), 1e-12);
  EXPECT_NEAR(out.lacks_m, 0.0, 1e-9);
  EXPECT_EQ(out.expected.size(), 1U);
}

/// The mean of two repeats has half the noise, but all of what the model lacks.
TEST_F(RecheckReadings, RepeatsOfAPoseShareWhatTheModelLacks) {
  floor_of(5e-5);
  Measurements rows = arm.poses(4, 28);
  rows.q.row(2) = rows.q.row(0);
  rows.q(2, 1) += 1e-4;  // resolution of the encoder
  const Readings out = expect_readings(arm.cell, run, own, rows);
  EXPECT_EQ(out.poses, 3);
  const Eigen::MatrixXd& C = out.expected[0].covariance;
  const double noise = out.noise_m * out.noise_m, lacks = out.lacks_m * out.lacks_m;
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(0.25 * (C(k, k) + C(6 + k, 6 + k) + 2.0 * C(k, 6 + k)), lacks + noise / 2.0,
                1e-9 * lacks);
    EXPECT_EQ(C(k, 3 + k), 0.0);
    EXPECT_EQ(C(k, 6 + (k + 1) % 3), 0.0);
  }
}

/// A reading that was thrown away says nothing of the noise, nor one of a set that is not used.
TEST_F(RecheckReadings, OutliersAndUnusedRowsDoNotCount) {
  const double before = expected_sigma(run, own);
  own.p_M(7, 0) += 0.1;
  EXPECT_GT(expected_sigma(run, own), 10.0 * before);
  offline::Run without = run;
  without.fit.calibration.outliers.push_back({.row = 7});
  run.fit.split.used[7] = false;
  EXPECT_NEAR(expected_sigma(run, own), before, 0.02 * before);
  EXPECT_DOUBLE_EQ(expected_sigma(without, own), expected_sigma(run, own));
}

TEST_F(RecheckReadings, WithTwoAxesThereAreTwoLinesAReading) {
  floor_of(5e-5);
  Measurements rows = arm.poses(4, 29);
  own.has_axis[2] = rows.has_axis[2] = false;
  own.p_M.col(2).setZero(), rows.p_M.col(2).setZero();
  const Readings out = expect_readings(arm.cell, run, own, rows);
  EXPECT_EQ(out.lines(), 8);
  for (const ExpectedError& view : out.expected) EXPECT_EQ(view.covariance.rows(), 8);
}

/// What the model left at a pose is expected there again, in the base frame.
TEST_F(RecheckReadings, AnEarlierErrorIsExpectedAgainWhereItIsNotNoise) {
  floor_of(1e-7);
  const Measurements rows = pick(own, {4, 9});
  const Readings out = expect_readings(arm.cell, run, own, rows);
  ASSERT_EQ(out.expected.size(), 2U);
  const Rows3 left = own.p_M - predict_points(arm.state, own);
  const Rows3 left_B = to_base(arm.state, own, left);
  EXPECT_LT((out.expected[1].mean_B.row(0) - left_B.row(4)).norm(), 1e-3 * kScatter_m);
  EXPECT_LT((out.expected[1].mean_B.row(1) - left_B.row(9)).norm(), 1e-3 * kScatter_m);
}

}  // namespace
}  // namespace plumb::offline::recheck
