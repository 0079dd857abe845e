// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "fit/fit.hpp"

namespace plumb::offline {

/// 95 % confidence interval of the mean error of all poses of a kind, and the standard error of the
/// sample mean [m]; NaN with fewer than three poses.
struct MeanInterval {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
  double se = std::numeric_limits<double>::quiet_NaN();
};

/// By Student's t with cluster-robust variance [Cameron & Miller 2015, eq. 6]: repeats of a pose,
/// whose errors are nearly the same, do not narrow the interval.
///
/// @param errors_m  3-D errors [m].
/// @param pose      The pose of each error, same shape.
MeanInterval mean_interval(const std::vector<double>& errors_m, const std::vector<int>& pose);

/// The interval of the held-out poses of a fit of these measurements.
MeanInterval held_out_interval(const Measurements& measured, const Fit& fit);

}  // namespace plumb::offline
