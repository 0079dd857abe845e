// SPDX-License-Identifier: Apache-2.0
#include "numbers/pivoted_qr.hpp"

#include <cmath>

namespace plumb::offline {

using Eigen::Index;
using Eigen::MatrixXd;

PivotedQr::PivotedQr(const MatrixXd& A) : qr_(A) {}

PivotedQr::PivotedQr(const MatrixXd& A, double threshold) : qr_(A) { qr_.setThreshold(threshold); }

double PivotedQr::pivot(Index k) const { return std::abs(qr_.matrixQR()(k, k)); }

Eigen::VectorXd PivotedQr::solved(const Eigen::VectorXd& b) const { return qr_.solve(b); }
MatrixXd PivotedQr::solved(const MatrixXd& B) const { return qr_.solve(B); }

MatrixXd PivotedQr::basis(Index count) const {
  return qr_.householderQ() * MatrixXd::Identity(qr_.rows(), count);
}

MatrixXd PivotedQr::triangle(Index count) const {
  return qr_.matrixQR().topLeftCorner(count, count).triangularView<Eigen::Upper>();
}

MatrixXd PivotedQr::ordered(const MatrixXd& B) const { return B * qr_.colsPermutation(); }
MatrixXd PivotedQr::in_place(const MatrixXd& B) const { return qr_.colsPermutation() * B; }

MatrixXd householder_basis(const MatrixXd& A, Index count) {
  return Eigen::HouseholderQR<MatrixXd>(A).householderQ() * MatrixXd::Identity(A.rows(), count);
}

}  // namespace plumb::offline
