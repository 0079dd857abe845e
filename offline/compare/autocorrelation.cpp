// SPDX-License-Identifier: Apache-2.0
#include "compare/autocorrelation.hpp"

#include <cmath>

#include "compare/constants.hpp"

namespace plumb::offline::compare {
namespace {

/// As Autocorrelation::closeness, with every joint in units of its standard deviation.
double closeness(const Series& series, const RowsN& q) {
  const RowsN visited = q(series.first_row, Eigen::all);
  const Eigen::RowVectorXd mean = visited.colwise().mean();
  RowsN unit = visited.rowwise() - mean;
  for (Eigen::Index j = 0; j < unit.cols(); ++j) {
    const double spread = std::sqrt(unit.col(j).squaredNorm() / static_cast<double>(unit.rows()));
    if (spread > 0.0) unit.col(j) /= spread;
  }
  const auto n = unit.rows();
  const double moved = (unit.bottomRows(n - 1) - unit.topRows(n - 1)).squaredNorm();
  const double any = 2.0 * unit.squaredNorm() * static_cast<double>(n - 1) / static_cast<double>(n);
  return any > 0.0 ? std::sqrt(moved / any) : 1.0;
}

}  // namespace

double lag_one(const Rows3& e) {
  const auto n = e.rows();
  const double squares = e.squaredNorm();
  if (n < 2 || !(squares > 0.0)) return 0.0;
  return e.topRows(n - 1).cwiseProduct(e.bottomRows(n - 1)).sum() / squares;
}

Autocorrelation autocorrelation(const Series& series, const RowsN& q) {
  Autocorrelation out;
  if (series.size() < kFewestForAutocorrelation) return out;
  const Rows3 e = series.error_M.rowwise() - series.error_M.colwise().mean();
  const Eigen::Matrix3d S = e.transpose() * e;
  if (!(S.trace() > 0.0)) return out;
  out.n = series.size();
  out.lag1 = lag_one(e);
  const double half = k95 * std::sqrt((S * S).trace() / out.n) / S.trace();
  out.low95 = -1.0 / out.n - half;
  out.high95 = -1.0 / out.n + half;
  out.closeness = closeness(series, q);
  return out;
}

}  // namespace plumb::offline::compare
