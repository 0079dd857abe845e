// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>

#include "numbers/plain.hpp"

namespace plumb::offline {

/// L L^T = A of a symmetric, positive definite matrix A, of which the lower triangle is read.
/// [Golub & Van Loan 2013, 4.2] Cost: n^3 / 3.
class Cholesky {
 public:
  Cholesky() = default;
  explicit Cholesky(const Eigen::MatrixXd& A);

  /// False if A is not positive definite; then nothing else means anything.
  bool exists() const { return llt_.info() == Eigen::Success; }

  /// A^-1 B.
  template <class B>
  Plain<B> solve(const Eigen::MatrixBase<B>& b) const {
    const Plain<B>& plain = b.derived();
    return solved(plain);
  }
  /// L^-1 B: lines whose covariance was A have unit covariance then.
  template <class B>
  Plain<B> whitened(const Eigen::MatrixBase<B>& b) const {
    const Plain<B>& plain = b.derived();
    return divided(plain);
  }
  /// B L^-T: the columns of B are orthonormal if A was B^T B.
  Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& B) const;

  /// The last `count` numbers of the diagonal of A^-1. Cost: count^3 / 6.
  Eigen::VectorXd inverse_diagonal(Eigen::Index count) const;

  double ln_det() const;
  Eigen::MatrixXd lower() const;  // L

 private:
  Eigen::VectorXd solved(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solved(const Eigen::MatrixXd& B) const;
  Eigen::VectorXd divided(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd divided(const Eigen::MatrixXd& B) const;

  Eigen::LLT<Eigen::MatrixXd> llt_;
};

/// L D L^T = A of a symmetric matrix that may be singular up to rounding. Cost: n^3 / 3.
class SymmetricSolver {
 public:
  SymmetricSolver() = default;
  explicit SymmetricSolver(const Eigen::MatrixXd& A);

  /// A^-1 B.
  template <class B>
  Plain<B> solve(const Eigen::MatrixBase<B>& b) const {
    const Plain<B>& plain = b.derived();
    return solved(plain);
  }
  Eigen::MatrixXd inverse() const;

 private:
  Eigen::VectorXd solved(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solved(const Eigen::MatrixXd& B) const;

  Eigen::LDLT<Eigen::MatrixXd> ldlt_;
};

}  // namespace plumb::offline
