// SPDX-License-Identifier: Apache-2.0
#include "numbers/lu.hpp"

#include <Eigen/LU>

namespace plumb::offline {

using Eigen::MatrixXd;

double determinant(const MatrixXd& A) { return A.determinant(); }

MatrixXd inverse(const MatrixXd& A) { return A.inverse(); }

std::optional<Eigen::VectorXd> solved_if_regular(const MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::FullPivLU<MatrixXd> lu(A);
  if (!lu.isInvertible()) return {};
  return lu.solve(b);
}

}  // namespace plumb::offline
