// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/QR>

#include "numbers/plain.hpp"

namespace plumb::offline {

/// A P = Q R, the columns in the order in which they add most: for least squares and for the rank
/// of columns that may depend on each other. [Golub & Van Loan 2013, 5.4.2] Cost: 2 rows columns^2.
class PivotedQr {
 public:
  explicit PivotedQr(const Eigen::MatrixXd& A);
  /// A column counts as independent if its pivot exceeds this share of the largest.
  PivotedQr(const Eigen::MatrixXd& A, double threshold);

  Eigen::Index rank() const { return qr_.rank(); }
  /// The pivot of column k in this order, > 0.
  double pivot(Eigen::Index k) const;

  /// x that makes |A x - B| least; 0 for columns beyond the rank.
  template <class B>
  Plain<B> solve(const Eigen::MatrixBase<B>& b) const {
    const Plain<B>& plain = b.derived();
    return solved(plain);
  }
  /// The first `count` columns of Q, (rows, count).
  Eigen::MatrixXd basis(Eigen::Index count) const;
  /// The first `count` rows and columns of R.
  Eigen::MatrixXd triangle(Eigen::Index count) const;
  /// B P, of a B with the columns of A; and P B.
  Eigen::MatrixXd ordered(const Eigen::MatrixXd& B) const;
  Eigen::MatrixXd in_place(const Eigen::MatrixXd& B) const;

 private:
  Eigen::VectorXd solved(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solved(const Eigen::MatrixXd& B) const;

  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
};

/// The first `count` columns of Q of A = Q R, columns in their own order; (rows, count).
Eigen::MatrixXd householder_basis(const Eigen::MatrixXd& A, Eigen::Index count);

}  // namespace plumb::offline
