// SPDX-License-Identifier: Apache-2.0
#include "numbers/rotation_fit.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace plumb::offline {
namespace {

Eigen::JacobiSVD<Eigen::Matrix3d> svd_of(const Eigen::Matrix3d& M) {
  return Eigen::JacobiSVD<Eigen::Matrix3d>(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
}

}  // namespace

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M) {
  const auto svd = svd_of(M);
  const double handed = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  return svd.matrixU() * Eigen::Vector3d(1, 1, handed).asDiagonal() * svd.matrixV().transpose();
}

NearestOrthogonal nearest_orthogonal(const Eigen::Matrix3d& M) {
  const auto svd = svd_of(M);
  return {svd.matrixU() * svd.matrixV().transpose(), svd.singularValues().sum()};
}

Eigen::Vector4d mean_quaternion(const Eigen::Matrix4d& sum) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(sum);
  const Eigen::Vector4d mean = eigen.eigenvectors().col(3);
  return mean(0) < 0 ? -mean : mean;
}

Eigen::Vector3d symmetric_eigenvalues(const Eigen::Matrix3d& S) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(S, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace plumb::offline
