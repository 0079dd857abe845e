// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "noise/error_stats.hpp"

namespace plumb::offline {

/// Which errors of readings that had no say stand far out of the scatter of the others. fit and
/// diagnose both ask here, so that they leave the same readings out.
struct StandingOut {
  std::vector<double> times;       // the usual scatter, of each error
  std::vector<std::size_t> which;  // of the errors, ascending
};

/// @param errors_m  3-D errors of readings with so many measured axes.
/// @param sigma_m   Noise of one axis; the usual scatter is never taken for less.
StandingOut standing_out(const std::vector<double>& errors_m, int axes, double sigma_m);

/// Whether so many of n are single bad readings, which no headline counts: up to one in seven.
bool are_single(std::size_t standing_out, std::size_t n);

/// Summary without those that stand out, if these are single ones.
ErrorStats usual_errors(std::vector<double> errors_m, int axes, double sigma_m);

}  // namespace plumb::offline
