// SPDX-License-Identifier: Apache-2.0
#include "diagnose/extension.hpp"

#include <Eigen/QR>

namespace plumb::offline {
namespace {

constexpr double kIndependentColumn = 1e-7;

}  // namespace

WhitenedFit extended(const WhitenedFit& whitened, const Regressor& regressor) {
  WhitenedFit out = whitened;
  Eigen::MatrixXd X = motions(whitened, regressor);
  const Eigen::Index fit = whitened.fit_lines;
  const Eigen::VectorXd norm = X.topRows(fit).colwise().norm().cwiseMax(1e-300);
  X = X * norm.cwiseInverse().asDiagonal();
  // Twice: what the first pass leaves of the model is rounding of large numbers.
  for (int pass = 0; pass < 2; ++pass)
    X -= whitened.U * (whitened.U.topRows(fit).transpose() * X.topRows(fit)).eval();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(X.topRows(fit));
  Eigen::Index rank = 0;
  while (rank < X.cols() && std::abs(qr.matrixQR()(rank, rank)) > kIndependentColumn) ++rank;
  Eigen::MatrixXd fresh = (X * qr.colsPermutation()).leftCols(rank);
  const Eigen::MatrixXd R = qr.matrixQR().topLeftCorner(rank, rank);
  R.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(fresh);
  const Eigen::VectorXd explained = fresh.topRows(fit).transpose() * whitened.y.head(fit);
  out.y -= fresh * explained;
  out.Q = out.y.head(fit).squaredNorm();
  out.U.conservativeResize(Eigen::NoChange, whitened.rank + rank);
  out.U.rightCols(rank) = fresh;
  out.rank = whitened.rank + rank;
  out.scatter_nats = 0.0;  // the first effect of an explanation has paid them
  fold_joints(out);
  return out;
}

}  // namespace plumb::offline
