// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <vector>

#include "cell/measurements.hpp"
#include "fit/calibration.hpp"
#include "fit/split.hpp"
#include "noise/error_stats.hpp"

namespace plumb::offline {

/// Rows whose residual is an outlier under the model as given, and the noise of one axis.
struct BadRows {
  std::set<int> rows;
  double sigma_m = 0.0;
};

/// Predictions of the held-out poses, each by a model that was fitted without them. Refers to
/// `settings` and `measured`.
class HeldOutPredictions {
 public:
  HeldOutPredictions(const MeasurementSettings& settings, const Measurements& measured,
                     const Split& split);

  /// Predicts the rows `held` by a model that was fitted to the rows `fitted`.
  void put(const Calibration& calibration, const std::vector<int>& fitted,
           const std::vector<int>& held);

  /// Rows that are outliers, if there are only a few; the verdict of a fit leaves the same ones
  /// out.
  std::set<int> bad_rows(double sigma_m) const;

  /// Errors of all rows but those that are bad both at the start and here. So a pose that the model
  /// has made worse counts, and a bad one that the model now predicts well counts too.
  ErrorStats stats(const BadRows& bad) const;

  /// Errors of the orientations of all rows [rad]; n = 0 where none were measured.
  ErrorStats turn_stats() const;

  /// Of each row, in the order of held_rows of the split.
  std::vector<double> errors_m() const;

 private:
  std::set<int> far_rows(const std::vector<double>& errors_m, double sigma_m) const;

  const MeasurementSettings* settings_;
  const Measurements* measured_;
  std::vector<int> rows_;
  Rows3 predicted_;
  Eigen::VectorXd turns_rad_;  // per row of the measurements; empty without orientations
};

}  // namespace plumb::offline
