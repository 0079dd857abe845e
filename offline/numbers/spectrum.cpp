// SPDX-License-Identifier: Apache-2.0
#include "numbers/spectrum.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace plumb::offline {

using Eigen::MatrixXd;

SymmetricEigen symmetric_eigen(const MatrixXd& S) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(S);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

double largest_generalised_eigenvalue(const MatrixXd& A, const MatrixXd& B) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, B, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

Eigen::VectorXd jacobi_singular_values(const MatrixXd& A) {
  return Eigen::JacobiSVD<MatrixXd>(A).singularValues();
}

RightSingular right_singular(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace plumb::offline
