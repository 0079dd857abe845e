// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "fit/fit.hpp"

namespace plumb::offline {

/// Where the mean error of all poses of a kind lies with a probability of 95 %, and the standard
/// error of the mean that is at hand [m]; NaN where fewer than three poses tell.
struct MeanInterval {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
  double se = std::numeric_limits<double>::quiet_NaN();
};

/// Student's t with the variance of whole groups [Cameron & Miller 2015, eq. 6], so that repeats of
/// a pose, which miss alike, do not narrow it.
///
/// @param errors_m  3-D errors [m].
/// @param pose      Pose that each of them belongs to, same shape.
MeanInterval mean_interval(const std::vector<double>& errors_m, const std::vector<int>& pose);

/// Of the held-out poses of a fit of these measurements.
MeanInterval held_out_interval(const Measurements& measured, const Fit& fit);

}  // namespace plumb::offline
