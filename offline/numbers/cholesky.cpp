// SPDX-License-Identifier: Apache-2.0
#include "numbers/cholesky.hpp"

#include <algorithm>

#include "numbers/products.hpp"

namespace plumb::offline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index kColumnsAtOnce = 48;

/// L^-1 B with the lower triangle of L, block of rows by block of rows: what the blocks above
/// contribute is a product of matrices.
MatrixXd lower_solved(const Eigen::Ref<const MatrixXd>& L, MatrixXd B) {
  for (Index first = 0; first < L.rows(); first += kColumnsAtOnce) {
    const Index size = std::min(kColumnsAtOnce, L.rows() - first);
    auto here = B.middleRows(first, size);
    here -= transposed_product(L.block(first, 0, size, first).transpose(), B.topRows(first));
    L.block(first, first, size, size).triangularView<Eigen::Lower>().solveInPlace(here);
  }
  return B;
}

}  // namespace

Cholesky::Cholesky(const MatrixXd& A) : llt_(A) {}

VectorXd Cholesky::solved(const VectorXd& b) const { return llt_.solve(b); }
MatrixXd Cholesky::solved(const MatrixXd& B) const { return llt_.solve(B); }
VectorXd Cholesky::divided(const VectorXd& b) const { return llt_.matrixL().solve(b); }
MatrixXd Cholesky::divided(const MatrixXd& B) const { return llt_.matrixL().solve(B); }

MatrixXd Cholesky::orthonormal(const MatrixXd& B) const {
  return llt_.matrixU().solve<Eigen::OnTheRight>(B);
}

VectorXd Cholesky::inverse_diagonal(Index count) const {
  // A column of L^-1 begins on the diagonal, and follows from the corner of L that begins there.
  VectorXd out(count);
  for (Index first = 0; first < count; first += kColumnsAtOnce) {
    const Index size = std::min(kColumnsAtOnce, count - first), rest = count - first;
    out.segment(first, size) =
        lower_solved(llt_.matrixLLT().bottomRightCorner(rest, rest), MatrixXd::Identity(rest, size))
            .colwise()
            .squaredNorm();
  }
  return out;
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
