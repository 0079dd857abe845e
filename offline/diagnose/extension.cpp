// SPDX-License-Identifier: Apache-2.0
#include "diagnose/extension.hpp"

#include <Eigen/QR>

namespace plumb::offline {
namespace {

constexpr double kIndependent = 1e-7;

}  // namespace

Stage extended(const Stage& stage, const Block& block) {
  Stage out = stage;
  Eigen::MatrixXd X = motions(stage, block);
  const Eigen::Index fit = stage.fit_lines;
  const Eigen::VectorXd norm = X.topRows(fit).colwise().norm().cwiseMax(1e-300);
  X = X * norm.cwiseInverse().asDiagonal();
  // Twice: what the first pass leaves of the model is rounding of large numbers.
  for (int pass = 0; pass < 2; ++pass)
    X -= stage.U * (stage.U.topRows(fit).transpose() * X.topRows(fit)).eval();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(X.topRows(fit));
  Eigen::Index rank = 0;
  while (rank < X.cols() && std::abs(qr.matrixQR()(rank, rank)) > kIndependent) ++rank;
  Eigen::MatrixXd fresh = (X * qr.colsPermutation()).leftCols(rank);
  const Eigen::MatrixXd R = qr.matrixQR().topLeftCorner(rank, rank);
  R.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(fresh);
  const Eigen::VectorXd explained = fresh.topRows(fit).transpose() * stage.y.head(fit);
  out.y -= fresh * explained;
  out.Q = out.y.head(fit).squaredNorm();
  out.U.conservativeResize(Eigen::NoChange, stage.rank + rank);
  out.U.rightCols(rank) = fresh;
  out.rank = stage.rank + rank;
  fold_joints(out);
  return out;
}

}  // namespace plumb::offline
