// SPDX-License-Identifier: Apache-2.0
#include "numbers/rotation_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace plumb::offline {
namespace {

const Eigen::Matrix3d kTurn =
    Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();

TEST(RotationFit, FindsTheTurnBetweenTwoSetsOfPoints) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d b(std::sin(1.7 * i), std::cos(2.3 * i), std::sin(0.4 * i + 1.0));
    sum += kTurn * b * b.transpose();
  }
  EXPECT_LT((nearest_rotation(sum) - kTurn).norm(), 1e-12);
}

TEST(RotationFit, IsNeverAMirror) {
  // Points of a plane leave the side open; noise across it must not turn it over.
  Eigen::Matrix3d flat = kTurn * Eigen::Vector3d(3.0, 2.0, -1e-3).asDiagonal();
  const Eigen::Matrix3d R = nearest_rotation(flat);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  EXPECT_LT((R - kTurn).norm(), 1e-12);
  EXPECT_LT(nearest_orthogonal(flat).Q.determinant(), 0.0);
  EXPECT_NEAR(nearest_orthogonal(flat).sum, 5.001, 1e-12);
}

TEST(RotationFit, AMeanOfQuaternionsDoesNotMindTheirSigns) {
  const Eigen::Vector4d q = Eigen::Vector4d(0.2, 0.4, -0.1, 0.7).normalized();
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const double sign : {1.0, -1.0, -1.0}) sum += (sign * q) * (sign * q).transpose();
  EXPECT_LT((mean_quaternion(sum) - q).norm(), 1e-12);
}

TEST(RotationFit, EigenvaluesAscend) {
  const Eigen::Matrix3d S = kTurn * Eigen::Vector3d(5.0, 1.0, 3.0).asDiagonal() * kTurn.transpose();
  EXPECT_LT((symmetric_eigenvalues(S) - Eigen::Vector3d(1.0, 3.0, 5.0)).norm(), 1e-12);
}

}  // namespace
}  // namespace plumb::offline
