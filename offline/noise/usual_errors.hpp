// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "noise/error_stats.hpp"

namespace plumb::offline {

/// Which held-out errors lie farther than six times the usual scatter of all of them. fit and
/// diagnose both use this, so that they leave out the same readings.
struct StandingOut {
  std::vector<double> times;       // each error over the usual scatter
  std::vector<std::size_t> which;  // indices of the errors that stand out, ascending
};

/// @param errors_m  3-D errors of readings with `axes` measured axes.
/// @param sigma_m   Noise of one axis: a lower bound of the usual scatter.
StandingOut standing_out(const std::vector<double>& errors_m, Eigen::Index axes, double sigma_m);

/// Whether `standing_out` of n readings are few enough, at most one in seven, to be single bad
/// readings, which no headline counts.
bool are_single(std::size_t standing_out, std::size_t n);

/// Summary of the errors without those that stand out, if these are few enough for that.
ErrorStats usual_errors(std::vector<double> errors_m, Eigen::Index axes, double sigma_m);

}  // namespace plumb::offline
