// SPDX-License-Identifier: Apache-2.0
#include "diagnose/extension.hpp"

#include "diagnose/series_scan.hpp"
#include "numbers/pivoted_qr.hpp"
#include "numbers/triangle.hpp"

namespace plumb::offline {
namespace {

constexpr double kIndependentColumn = 1e-7;

}  // namespace

WhitenedFit extended(const WhitenedFit& whitened, const Regressor& regressor,
                     const Eigen::VectorXd& theta) {
  WhitenedFit out = whitened;
  const Eigen::Index fit = whitened.fit_lines;
  if (!regressor.joints.empty()) {
    const Eigen::VectorXd moved = motion(whitened, regressor, theta);
    out.y -= moved - whitened.U * (whitened.U.topRows(fit).transpose() * moved.head(fit));
  }
  Eigen::MatrixXd X = regressor.joints.empty()
                          ? motions(whitened, regressor)
                          : motions(whitened, smooth_part(whitened, regressor));
  const Eigen::VectorXd norm = X.topRows(fit).colwise().norm().cwiseMax(1e-300);
  X = X * norm.cwiseInverse().asDiagonal();
  // Gram-Schmidt twice: after one pass rounding leaves the columns not quite orthogonal.
  for (int pass = 0; pass < 2; ++pass)
    X -= whitened.U * (whitened.U.topRows(fit).transpose() * X.topRows(fit)).eval();
  const PivotedQr qr(X.topRows(fit));
  Eigen::Index rank = 0;
  while (rank < X.cols() && qr.pivot(rank) > kIndependentColumn) ++rank;
  const Eigen::MatrixXd fresh = divided_by_upper(qr.ordered(X).leftCols(rank), qr.triangle(rank));
  const Eigen::VectorXd explained = fresh.topRows(fit).transpose() * out.y.head(fit);
  out.y -= fresh * explained;
  out.Q = out.y.head(fit).squaredNorm();
  out.U.conservativeResize(Eigen::NoChange, whitened.rank + rank);
  out.U.rightCols(rank) = fresh;
  out.rank = whitened.rank + rank;
  out.scatter_nats = 0.0;  // already subtracted from the evidence of the first effect
  fold_joints(out);
  return out;
}

}  // namespace plumb::offline
