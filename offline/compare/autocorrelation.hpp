// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "noise/series.hpp"

namespace plumb::offline::compare {

/// Correlation of each residual with the one measured just before.
struct Autocorrelation {
  int n = 0;           // visits
  double lag1 = 0.0;   // sum e_t . e_{t+1} / sum |e_t|^2, mean removed
  double low95 = 0.0;  // lag1 of independent residuals lies between these two in 95 %
  double high95 = 0.0;
  /// RMS joint-space distance of successive poses over that of any two poses. Below 1/2, successive
  /// poses are so close that errors which depend on the pose alone may cause lag1.
  double closeness = 1.0;
  bool beyond() const { return n > 0 && (lag1 < low95 || lag1 > high95); }
};

/// n is 0 below 8 visits. With covariance S of the residuals, lag1 of independent residuals has
/// mean -1 / n and variance tr(S^2) / tr(S)^2 / n, so that three equal axes count as three times as
/// many values [Box & Jenkins 1976].
Autocorrelation autocorrelation(const Series& series, const RowsN& q);

/// lag1 without subtracting the mean. e: shape (n, 3).
double lag_one(const Rows3& e);

}  // namespace plumb::offline::compare
