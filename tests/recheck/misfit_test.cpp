// SPDX-License-Identifier: Apache-2.0
#include "recheck/misfit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

#include "recheck/constants.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kLacks_m = 1e-4, kNoise_m = 2e-5;

/// Covariance of what the model lacks over all rows of both, of one axis.
Eigen::MatrixXd dense(const Measurements& own, const Measurements& rows, double length) {
  RowsN q(own.size() + rows.size(), own.q.cols());
  q << own.q, rows.q;
  Eigen::MatrixXd out(q.rows(), q.rows());
  for (Eigen::Index a = 0; a < q.rows(); ++a)
    for (Eigen::Index b = 0; b < q.rows(); ++b)
      out(a, b) = kLacks_m * kLacks_m * std::exp(-(q.row(a) - q.row(b)).norm() / length);
  return out;
}

/// Forty readings of a calibration, whose errors are a function of the joints of that length, and
/// three new ones, in a part of the joints where neighbours are near.
struct RecheckMisfit : testing::Test {
  void make(double length, std::uint64_t seed) {
    own = arm.poses(40, seed), rows = arm.poses(3, seed + 1);
    own.q *= 0.2, rows.q *= 0.2;
    rows.q.row(0) = own.q.row(5);
    known.resize(40);
    std::iota(known.begin(), known.end(), 0);
    tests::Random random(seed);
    Eigen::MatrixXd K = dense(own, rows, length).topLeftCorner(40, 40);
    K.diagonal().array() += kNoise_m * kNoise_m;
    const Eigen::MatrixXd L = K.llt().matrixL();
    Rows3 white(40, 3);
    for (double& w : white.reshaped()) w = normal(random);
    error = L * white;
  }
  Misfit expected() const {
    return expected_misfit(own, known, error, rows,
                           {.lacks_m = kLacks_m, .noise_m = kNoise_m, .axes = 3});
  }
  /// ln of the density of the errors, by determinant and inverse.
  double ln_density(double length) const {
    Eigen::MatrixXd K = dense(own, rows, length).topLeftCorner(40, 40);
    K.diagonal().array() += kNoise_m * kNoise_m;
    K /= kLacks_m * kLacks_m;
    return -1.5 * std::log(K.determinant()) -
           0.5 * (error.transpose() * K.inverse() * error).trace() / (kLacks_m * kLacks_m);
  }

  SmallArm arm;
  Measurements own, rows;
  std::vector<int> known;
  Rows3 error;
};

/// By the inverse of the joint covariance of old and new ones: its block of the new ones is the
/// inverse of their covariance given the old ones.
TEST_F(RecheckMisfit, IsTheConditionalOfTheJointNormalOfTheLikeliestLength) {
  for (const double made : {0.1, 0.4, 1.6}) {
    make(made, 40);
    double length = kLengths[0];
    for (const double one : kLengths)
      if (ln_density(one) > ln_density(length)) length = one;
    Eigen::MatrixXd joint = dense(own, rows, length);
    joint.diagonal().head(40).array() += kNoise_m * kNoise_m;
    joint.diagonal().tail(3).array() += 1e-16;  // the first one is measured again
    const Eigen::MatrixXd precision = joint.inverse();
    const Eigen::MatrixXd covariance = precision.bottomRightCorner(3, 3).inverse();
    const Misfit misfit = expected();
    EXPECT_LT((misfit.covariance - covariance).norm(), 1e-5 * covariance.norm()) << made;
    const Eigen::MatrixXd weights = -covariance * precision.bottomLeftCorner(3, 40);
    EXPECT_LT((misfit.weights - weights).norm(), 1e-5) << made;
  }
}

TEST_F(RecheckMisfit, APoseThatIsMeasuredAgainErrsAsBefore) {
  make(0.4, 50);
  const Misfit misfit = expected();
  EXPECT_NEAR(misfit.weights(0, 5), 1.0, 0.15);
  EXPECT_LT(misfit.covariance(0, 0), 2.0 * kNoise_m * kNoise_m);
  EXPECT_GT(misfit.covariance(1, 1), 2.0 * misfit.covariance(0, 0));
}

TEST_F(RecheckMisfit, TheOrderOfTheOldReadingsIsOfNoConsequence) {
  make(0.4, 60);
  const Misfit forward = expected();
  std::reverse(known.begin(), known.end());
  const Misfit backward = expected();
  EXPECT_LT((forward.covariance - backward.covariance).norm(), 1e-9 * forward.covariance.norm());
  EXPECT_LT((forward.weights.rowwise().reverse() - backward.weights).norm(), 1e-9);
}

}  // namespace
}  // namespace plumb::offline::recheck
