// SPDX-License-Identifier: Apache-2.0
#include "numbers/cholesky.hpp"

namespace plumb::offline {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Cholesky::Cholesky(const MatrixXd& A) : llt_(A) {}

VectorXd Cholesky::solved(const VectorXd& b) const { return llt_.solve(b); }
MatrixXd Cholesky::solved(const MatrixXd& B) const { return llt_.solve(B); }
VectorXd Cholesky::divided(const VectorXd& b) const { return llt_.matrixL().solve(b); }
MatrixXd Cholesky::divided(const MatrixXd& B) const { return llt_.matrixL().solve(B); }

MatrixXd Cholesky::orthonormal(const MatrixXd& B) const {
  return llt_.matrixU().solve<Eigen::OnTheRight>(B);
}

double Cholesky::ln_det() const { return 2.0 * llt_.matrixLLT().diagonal().array().log().sum(); }

MatrixXd Cholesky::lower() const { return llt_.matrixL(); }

SymmetricSolver::SymmetricSolver(const MatrixXd& A) : ldlt_(A) {}

VectorXd SymmetricSolver::solved(const VectorXd& b) const { return ldlt_.solve(b); }
MatrixXd SymmetricSolver::solved(const MatrixXd& B) const { return ldlt_.solve(B); }

MatrixXd SymmetricSolver::inverse() const {
  return ldlt_.solve(MatrixXd::Identity(ldlt_.rows(), ldlt_.cols()));
}

}  // namespace plumb::offline
