// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "compare/autocorrelation.hpp"
#include "compare/lack_of_fit.hpp"
#include "numbers/tails.hpp"
#include "residual_cases.hpp"

namespace plumb::offline::compare {
namespace {

TEST(FTail, HasTheClosedFormsOfTwoDegreesOfFreedom) {
  for (const double f : {0.01, 0.5, 1.0, 3.0, 40.0, 1e6})
    for (const double b : {1.0, 3.0, 10.0, 137.0, 4000.0}) {
      const double two_above = -b / 2.0 * std::log1p(2.0 * f / b);
      EXPECT_NEAR(ln_f_tail(f, 2.0, b), two_above, 1e-9 * std::max(1.0, -two_above))
          << f << " " << b;
      const long double inside = powl(b * f / (2.0L + b * f), b / 2.0L);
      EXPECT_NEAR(ln_f_tail(f, b, 2.0), static_cast<double>(log1pl(-inside)), 1e-8)
          << f << " " << b;
    }
  EXPECT_EQ(ln_f_tail(0.0, 3.0, 4.0), 0.0);
}

TEST(FTail, OfOneAndOneIsTheCauchyDistributionAndOppositeTailsAddToOne) {
  tests::Random random(4);
  for (int k = 0; k < 1000; ++k) {
    const double f = std::exp(random.uniform(-5.0, 5.0));
    EXPECT_NEAR(std::exp(ln_f_tail(f, 1.0, 1.0)), 1.0 - 2.0 / M_PI * std::atan(std::sqrt(f)),
                1e-10);
    const double a = random.uniform(1.0, 300.0), b = random.uniform(1.0, 300.0);
    EXPECT_NEAR(std::exp(ln_f_tail(f, a, b)) + std::exp(ln_f_tail(1.0 / f, b, a)), 1.0, 1e-9);
  }
}

/// e_t = phi e_{t-1} + noise of covariance diag(1, 4, 0.25).
void autoregressive(ResidualCase& at, double phi) {
  const double size[] = {1.0, 2.0, 0.5};
  for (int k = 0; k < 3; ++k) {
    double e = size[k] * normal(at.random) / std::sqrt(1.0 - phi * phi);
    for (int i = 0; i < at.size(); ++i) {
      at.error(i, k) = 1e-5 * e;
      e = phi * e + size[k] * normal(at.random);
    }
  }
}

TEST(Autocorrelation, OfAnAutoregressiveSeriesIsItsCoefficient) {
  ResidualCase at(3, 20000);
  for (const double phi : {-0.6, 0.0, 0.3, 0.8}) {
    autoregressive(at, phi);
    EXPECT_NEAR(autocorrelation(at.in_order(), at.measured.q).lag1, phi, 0.02);
  }
}

TEST(Autocorrelation, OfIndependentResidualsLiesInsideItsBoundsInNineteenOfTwentySeries) {
  const int count = static_cast<int>(tests::scaled(1000));
  std::printf("[ seeds    ] 1 .. %d\n", count);
  ResidualCase at(5, 60);
  int beyond = 0;
  for (int k = 0; k < count; ++k) {
    autoregressive(at, 0.0);
    beyond += autocorrelation(at.in_order(), at.measured.q).beyond() ? 1 : 0;
  }
  EXPECT_GT(beyond, 0.025 * count);
  EXPECT_LT(beyond, 0.075 * count);
}

TEST(Autocorrelation, RepeatsOfAPoseAreNoMemoryAndPosesInDrivingOrderAreSaidToBeClose) {
  ResidualCase at(6, 400);
  at.add_noise(1e-5);
  for (int i = 0; i < 400; ++i) {
    at.measured.replicate_group[i] = i / 4;
    at.error.row(i) += 5.0 * at.error.row(i / 4 * 4);  // what the pose shares
  }
  EXPECT_EQ(at.in_order().size(), 100);
  EXPECT_FALSE(autocorrelation(at.in_order(), at.measured.q).beyond());
  EXPECT_NEAR(autocorrelation(at.in_order(), at.measured.q).closeness, 1.0, 0.15);
  for (int i = 0; i < 400; ++i) at.measured.q.row(i).setConstant(0.01 * i);
  EXPECT_LT(autocorrelation(at.in_order(), at.measured.q).closeness, 0.1);
}

TEST(Series, FollowsTheClockWhereThereIsOne) {
  ResidualCase at(7, 10);
  at.measured.context.time_s = Eigen::VectorXd::LinSpaced(10, 90.0, 0.0);
  EXPECT_EQ(at.in_order().first_row.front(), 9);
  at.measured.context.time_s(3) = NAN;
  EXPECT_EQ(at.in_order().first_row.front(), 0);
}

/// Residuals of a linear fit with `parameters` columns, repeats and something the model lacks;
/// `warm`: repeats of a pose are at other temperatures, which move them so far.
LackOfFit fitted(std::uint64_t seed, double missing, double sigma, double warm = 0.0) {
  const int poses = 40, times = 3, parameters = 12, n = poses * times;
  ResidualCase at(seed, n);
  Eigen::MatrixXd X(3 * n, parameters);
  Eigen::VectorXd y(3 * n);
  for (int g = 0; g < poses; ++g) {
    Eigen::MatrixXd block(3, parameters);
    for (double& v : block.reshaped()) v = normal(at.random);
    const Eigen::Vector3d lack(missing * normal(at.random), missing * normal(at.random),
                               missing * normal(at.random));
    for (int k = 0; k < times; ++k) {
      const int row = g * times + k;
      at.measured.replicate_group[row] = g;
      X.middleRows(3 * row, 3) = block;
      for (int c = 0; c < 3; ++c) y(3 * row + c) = lack(c) + sigma * normal(at.random);
    }
  }
  const Eigen::VectorXd left = y - X * X.householderQr().solve(y);
  for (int i = 0; i < n; ++i) at.error.row(i) = left.segment<3>(3 * i).transpose();
  std::vector<int> rows;
  for (int i = 0; i < n; ++i) rows.push_back(i);
  NoiseFloor floor;
  floor.sigma_m = sigma;
  if (warm > 0.0) {
    at.measured.context.temperature.resize(n, 1);
    for (int i = 0; i < n; ++i) {
      at.measured.context.temperature(i, 0) = 20.0 + 10.0 * (i % times);
      at.error(i, 2) += warm * ((i % times) - 0.5 * (times - 1));
    }
  }
  return lack_of_fit(at.measured, at.error, rows, parameters, floor);
}

TEST(LackOfFit, RepeatsAtOtherTemperaturesAreNoPureError) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const LackOfFit found = fitted(seed, 0.0, 1e-5, 1e-4);
    EXPECT_TRUE(found.significant()) << "seed " << seed;
    EXPECT_GT(found.systematic, 0.5) << "seed " << seed;
  }
}

TEST(LackOfFit, OfACompleteModelIsOneAndItsChanceIsUniform) {
  const int count = static_cast<int>(tests::scaled(400));
  std::printf("[ seeds    ] 1 .. %d\n", count);
  double sum = 0.0;
  int below_tenth = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const LackOfFit found = fitted(static_cast<std::uint64_t>(seed), 0.0, 1e-5);
    EXPECT_EQ(found.dof_model, 3 * 40 - 12);
    EXPECT_EQ(found.dof_noise, 3 * 80);
    sum += found.ratio / count;
    below_tenth += found.ln_p < std::log(0.1) ? 1 : 0;
  }
  EXPECT_NEAR(sum, 240.0 / 238.0, 0.03);
  EXPECT_NEAR(below_tenth, 0.1 * count, 4.0 * std::sqrt(0.09 * count));
}

TEST(LackOfFit, OfALackingModelIsOnePlusTheRepeatsTimesWhatItLacks) {
  double ratio = 0.0, systematic = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const LackOfFit found = fitted(seed, 3e-5, 1e-5);
    EXPECT_TRUE(found.significant());
    ratio += found.ratio / 100.0;
    systematic += found.systematic / 100.0;
  }
  EXPECT_NEAR(ratio, (1.0 + 3.0 * 9.0) * 240.0 / 238.0, 1.0);
  EXPECT_NEAR(systematic, 0.9, 0.02);
}

}  // namespace
}  // namespace plumb::offline::compare
