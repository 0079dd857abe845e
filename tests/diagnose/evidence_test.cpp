// SPDX-License-Identifier: Apache-2.0
#include "diagnose/evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr double kWidths[] = {0.1, 0.3, 1.0, 3.0, 10.0, 30.0};

double normal(tests::Random& dice) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += dice.uniform(0.0, 1.0);
  return sum;
}

/// ln of the integral over theta of the likelihood, for one column: with the noise integrated out,
/// the marginal of y is a Student t whose scale is nu s^2 + Q - ...; here theta is done by plain
/// summation in long double, at the variance ratio the formula conditions on.
long double ln_bayes_by_summation(const std::vector<double>& x, const std::vector<double>& y,
                                  double tau, double s) {
  long double sum = 0.0L;
  const int steps = 40001;
  const long double half = 12.0L * tau, dt = 2 * half / (steps - 1);
  for (int i = 0; i < steps; ++i) {
    const long double theta = -half + i * dt;
    long double exponent = -0.5L * theta * theta / (tau * tau);
    for (std::size_t k = 0; k < x.size(); ++k)
      exponent -= 0.5L * ((y[k] - theta * x[k]) * (y[k] - theta * x[k]) - y[k] * y[k]) / (s * s);
    sum += std::exp(exponent);
  }
  return std::log(sum * dt / (tau * std::sqrt(2.0L * M_PIl)));
}

TEST(Evidence, OfOneColumnEqualsTheIntegralWhenTheNoiseIsKnown) {
  tests::Random dice(1);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> x, y;
    double XX = 0, Xy = 0, Q = 0;
    for (int i = 0; i < 30; ++i) {
      x.push_back(normal(dice));
      y.push_back(0.4 * x.back() + normal(dice));
      XX += x.back() * x.back();
      Xy += x.back() * y.back();
      Q += y.back() * y.back();
    }
    // Endless degrees of freedom: the noise is 1 for certain.
    const EvidenceScale known{.variance = 1.0, .dof = 1e9, .lines = 30};
    long double mean = 0.0L;
    for (const double tau : kWidths) mean += std::exp(ln_bayes_by_summation(x, y, tau, 1.0));
    const double expected = static_cast<double>(std::log(mean / std::size(kWidths)));
    const Eigen::MatrixXd gram = Eigen::MatrixXd::Constant(1, 1, XX);
    EXPECT_NEAR(evidence(gram, Eigen::VectorXd::Constant(1, Xy), Q, known).ln_bayes, expected,
                1e-4);
  }
}

TEST(Evidence, DoesNotDependOnWhichWayTheColumnsAreTurned) {
  tests::Random dice(2);
  Eigen::MatrixXd X(60, 3);
  Eigen::VectorXd y(60);
  for (Eigen::Index i = 0; i < 60; ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) X(i, k) = normal(dice);
    y(i) = normal(dice) + X(i, 0);
  }
  const EvidenceScale scale{.variance = 1.0, .dof = 4.0, .lines = 60};
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::MatrixXd Z = X * turn;
  EXPECT_NEAR(evidence(X.transpose() * X, X.transpose() * y, y.squaredNorm(), scale).ln_bayes,
              evidence(Z.transpose() * Z, Z.transpose() * y, y.squaredNorm(), scale).ln_bayes,
              1e-9);
}

TEST(Evidence, OfPureNoiseSpeaksAgainstMoreColumns) {
  tests::Random dice(3);
  int against = 0;
  double one = 0.0, eight = 0.0;
  constexpr int kRounds = 200;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixXd X(200, 8);
    Eigen::VectorXd y(200);
    for (Eigen::Index i = 0; i < 200; ++i) {
      for (Eigen::Index k = 0; k < 8; ++k) X(i, k) = normal(dice);
      y(i) = normal(dice);
    }
    const EvidenceScale scale{.variance = 1.0, .dof = 4.0, .lines = 200};
    const auto of = [&](Eigen::Index count) {
      const Eigen::MatrixXd Z = X.leftCols(count);
      return evidence(Z.transpose() * Z, Z.transpose() * y, y.squaredNorm(), scale).ln_bayes;
    };
    against += of(8) < 0.0;
    one += of(1) / kRounds;
    eight += of(8) / kRounds;
  }
  EXPECT_GE(against, 0.97 * kRounds);
  EXPECT_LT(eight, one);
}

}  // namespace
}  // namespace plumb::offline
