// SPDX-License-Identifier: Apache-2.0
#include "numbers/triangle.hpp"

#include <Eigen/QR>
#include <algorithm>

namespace plumb::offline {

using Eigen::MatrixXd;

MatrixXd householder_triangle(const MatrixXd& A) {
  return Eigen::HouseholderQR<MatrixXd>(A)
      .matrixQR()
      .topRows(std::min(A.rows(), A.cols()))
      .triangularView<Eigen::Upper>();
}

Eigen::VectorXd per_norm(const MatrixXd& A) {
  return A.colwise().norm().cwiseMax(1e-300).cwiseInverse();
}

MatrixXd upper_solved(const MatrixXd& R, const MatrixXd& B) {
  return R.triangularView<Eigen::Upper>().solve(B);
}

MatrixXd upper_transposed_solved(const MatrixXd& R, const MatrixXd& B) {
  return R.triangularView<Eigen::Upper>().transpose().solve(B);
}

MatrixXd divided_by_upper(const MatrixXd& A, const MatrixXd& R) {
  return R.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(A);
}

}  // namespace plumb::offline
