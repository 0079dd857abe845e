// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "numbers/gaussian.hpp"
#include "numbers/quantile.hpp"

namespace plumb::offline {
namespace {

// Readings y = x theta + noise of standard deviation sigma. theta is 0 or has the prior
// N(0, (t sigma)^2), and 1 / sigma^2 has a Gamma prior with `dof` degrees of freedom about
// 1 / variance. The evidence is integrated on a grid here, to check the closed form.
constexpr double kDof = 4.0, kVariance = 0.8, kT = 1.5;
const Eigen::VectorXd kX = (Eigen::VectorXd(5) << 1.0, -0.5, 2.0, 0.3, -1.2).finished();
const Eigen::VectorXd kY = (Eigen::VectorXd(5) << 1.4, -0.1, 2.6, 0.9, -1.0).finished();

double likelihood(double theta, double sigma) {
  return std::pow(sigma, -5.0) * std::exp(-0.5 * (kY - kX * theta).squaredNorm() / (sigma * sigma));
}

double integrated(bool with_model) {
  double sum = 0.0;
  for (double u = -6.0; u < 6.0; u += 0.01) {  // ln sigma
    const double sigma = std::exp(u);
    const double known =
        std::pow(sigma, -kDof) * std::exp(-0.5 * kDof * kVariance / (sigma * sigma));
    if (!with_model) {
      sum += known * likelihood(0.0, sigma);
      continue;
    }
    double inner = 0.0;
    for (double v = -8.0; v < 8.0; v += 0.02)  // theta in units of its prior
      inner +=
          0.02 * std::exp(-0.5 * v * v) / std::sqrt(2.0 * M_PI) * likelihood(v * kT * sigma, sigma);
    sum += known * inner;
  }
  return sum;
}

TEST(Evidence, IsWhatIntegrationGives) {
  const double xx = kX.squaredNorm(), xy = kX.dot(kY);
  const EvidenceGain gain =
      evidence_gain(std::log(1.0 + kT * kT * xx), kDof * kVariance + kY.squaredNorm(),
                    xy * xy / (xx + 1.0 / (kT * kT)), kDof + 5.0);
  EXPECT_NEAR(gain.ln_bayes, std::log(integrated(true) / integrated(false)), 1e-4);
}

TEST(Evidence, APerfectFitLeavesARoundingBehind) {
  EXPECT_GT(evidence_gain(0.0, 3.0, 3.0, 10.0).after, 0.0);
  EXPECT_TRUE(std::isfinite(evidence_gain(0.0, 3.0, 4.0, 10.0).ln_bayes));
}

TEST(Evidence, ANormalDensityIsTheProductOfItsAxes) {
  const Eigen::VectorXd x = Eigen::Vector2d(0.7, -2.0);
  const Eigen::MatrixXd S = Eigen::Vector2d(4.0, 0.25).asDiagonal();
  const double expected = -0.5 * (0.49 / 4.0 + 4.0 / 0.25) - 0.5 * std::log(4.0 * 0.25);
  EXPECT_NEAR(ln_normal(x, Cholesky(S)), expected, 1e-13);
}

TEST(Evidence, APriorCountsAsOneReadingOfEachNumber) {
  Eigen::MatrixXd X(4, 2), with(6, 2);
  X << 1.0, 0.3, -0.5, 2.0, 0.7, -1.1, 0.2, 0.4;
  const Eigen::VectorXd sigma = Eigen::Vector2d(0.5, 4.0);
  with << X, Eigen::MatrixXd(sigma.cwiseInverse().asDiagonal());
  const Eigen::MatrixXd own = X.transpose() * X;
  EXPECT_LT((with_prior(own, sigma) - with.transpose() * with).norm(), 1e-13);
  // Of the first number nothing is known beforehand.
  const Eigen::MatrixXd of_last = with_prior(own, Eigen::Vector2d(HUGE_VAL, sigma(1)));
  EXPECT_EQ(of_last(0, 0), own(0, 0));
  EXPECT_EQ(of_last(1, 1), with_prior(own, sigma)(1, 1));
  const double variance = 0.3;
  EXPECT_LT((with_prior(own, 2.0, variance) / variance -
             with_prior(own / variance, Eigen::VectorXd::Constant(2, 2.0)))
                .norm(),
            1e-12);
  EXPECT_LT((with_prior(X.transpose() * X) - own - Eigen::Matrix2d::Identity()).norm(), 1e-13);
}

TEST(Evidence, SumsOfExponentialsDoNotOverflow) {
  EXPECT_NEAR(ln_sum(std::array{1000.0, 1000.0}), 1000.0 + std::log(2.0), 1e-12);
  EXPECT_EQ(ln_sum({}), -HUGE_VAL);
}

TEST(Evidence, AQuantileIsOneOfTheValues) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 0.25), 2.0);
  EXPECT_EQ(median({}), 0.0);
}

}  // namespace
}  // namespace plumb::offline
