// SPDX-License-Identifier: Apache-2.0
#include "fit/mean_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cell/random.hpp"

namespace plumb::offline {
namespace {

double normal(Random& random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.unit())) * std::cos(2.0 * M_PI * random.unit());
}

/// A distance such as a position error is: the length of a normal vector.
double error(Random& random) {
  return std::sqrt(std::pow(normal(random), 2) + std::pow(normal(random), 2) +
                   std::pow(normal(random), 2));
}

constexpr double kTruth = 1.5957691216;  // mean length of a normal vector in space

/// Share of the intervals from `poses` poses of `repeats` readings each that contain the truth.
/// Repeats of a pose miss alike.
double coverage(int poses, int repeats) {
  Random random(17);
  constexpr int kTrials = 4000;
  int inside = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> errors;
    std::vector<int> pose;
    for (int p = 0; p < poses; ++p) {
      const double e = error(random);
      for (int r = 0; r < repeats; ++r) errors.push_back(e), pose.push_back(p);
    }
    const MeanInterval found = mean_interval(errors, pose);
    inside += found.low <= kTruth && kTruth <= found.high ? 1 : 0;
  }
  return static_cast<double>(inside) / kTrials;
}

TEST(MeanInterval, ContainsTheTruthInNinetyFiveOfAHundredCases) {
  for (const int poses : {8, 12, 48, 200}) {
    EXPECT_GT(coverage(poses, 1), 0.935) << poses;
    EXPECT_LT(coverage(poses, 1), 0.965) << poses;
  }
}

TEST(MeanInterval, CountsRepeatsOfAPoseOnce) {
  EXPECT_GT(coverage(30, 4), 0.935);
  EXPECT_LT(coverage(30, 4), 0.965);
}

TEST(MeanInterval, IsUnknownOfTwoPosesAndNeverBelowZero) {
  EXPECT_TRUE(std::isnan(mean_interval({1.0, 2.0, 2.0}, {0, 1, 1}).low));
  EXPECT_TRUE(std::isnan(mean_interval({}, {}).high));
  const MeanInterval wide = mean_interval({0.0, 0.0, 9.0}, {0, 1, 2});
  EXPECT_EQ(wide.low, 0.0);
  EXPECT_GT(wide.high, 9.0);
}

TEST(MeanInterval, OfThreePosesUsesStudentsT) {
  // mean 2, se 1 / sqrt(3), t(2) = 4.3027
  const MeanInterval found = mean_interval({1.0, 2.0, 3.0}, {0, 1, 2});
  EXPECT_NEAR(found.high, 2.0 + 4.3027 / std::sqrt(3.0), 0.03);
}

TEST(MeanInterval, StandardErrorIsThatOfTheMeanOfThePoses) {
  // sd of 1, 2, 3, 4, 5 over the root of 5; repeats of a pose add nothing.
  const double se = std::sqrt(2.5 / 5.0);
  EXPECT_NEAR(mean_interval({1, 2, 3, 4, 5}, {0, 1, 2, 3, 4}).se, se, 1e-12);
  EXPECT_NEAR(mean_interval({1, 1, 2, 2, 3, 3, 4, 4, 5, 5}, {0, 0, 1, 1, 2, 2, 3, 3, 4, 4}).se, se,
              1e-12);
  EXPECT_TRUE(std::isnan(mean_interval({1, 2}, {0, 1}).se));
}

}  // namespace
}  // namespace plumb::offline
