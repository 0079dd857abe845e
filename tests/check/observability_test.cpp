// SPDX-License-Identifier: Apache-2.0
#include "check/observability.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr int kPoses = 9, kNumbers = 4;

Eigen::MatrixXd random_jacobian(std::uint64_t seed) {
  tests::Random random(seed);
  Eigen::MatrixXd J(3 * kPoses, kNumbers);
  for (double& j : J.reshaped()) j = random.uniform(-1.0, 1.0);
  return J;
}

Observability of(const Eigen::MatrixXd& J) {
  return observability(J.bdcSvd().singularValues(), static_cast<int>(J.rows()) / 3);
}

/// Determinant, norms and extremes of the information matrix, not its singular values.
TEST(Observability, IsWhatTheInformationMatrixSays) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const Eigen::MatrixXd J = random_jacobian(seed), N = J.transpose() * J;
    const Observability o = of(J);
    EXPECT_NEAR(o.O1, std::pow(N.determinant(), 0.5 / kNumbers) / std::sqrt(1.0 * kPoses), 1e-12);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(N);
    const double most = std::sqrt(eigen.eigenvalues().maxCoeff());
    const double least =
        1.0 /
        std::sqrt(
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(N.inverse()).eigenvalues().maxCoeff());
    EXPECT_NEAR(o.O2, least / most, 1e-10);
    EXPECT_NEAR(o.O3, least, 1e-10);
    EXPECT_NEAR(o.O4, least * least / most, 1e-10);
    EXPECT_NEAR(o.O5, 1.0 / eigen.operatorInverseSqrt().trace(), 1e-10);
  }
}

TEST(Observability, APoseMoreNeverShowsTheWeakestNumberWorse) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const Eigen::MatrixXd J = random_jacobian(seed);
    const Observability fewer = of(J.topRows(3 * kPoses - 3)), all = of(J);
    EXPECT_GE(all.O3, fewer.O3);
    EXPECT_GE(all.O5, fewer.O5);
  }
}

TEST(Observability, PosesMeasuredTwiceCountAsManyAndNotAsBetterOnes) {
  const Eigen::MatrixXd J = random_jacobian(3);
  Eigen::MatrixXd twice(2 * J.rows(), kNumbers);
  twice << J, J;
  EXPECT_NEAR(of(twice).O1, of(J).O1, 1e-12);
  EXPECT_NEAR(of(twice).O2, of(J).O2, 1e-12);
}

TEST(Observability, ANumberThatNoPoseShowsMakesAllOfThemZero) {
  for (const Eigen::VectorXd& s : {Eigen::VectorXd(Eigen::Vector3d(2.0, 1.0, 0.0)),
                                   Eigen::VectorXd(Eigen::Vector3d(2.0, 1.0, NAN))}) {
    const Observability o = observability(s, 5);
    for (const double one : {o.O1, o.O2, o.O3, o.O4, o.O5}) EXPECT_EQ(one, 0.0);
  }
}

}  // namespace
}  // namespace plumb::offline
