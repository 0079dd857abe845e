// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/fit.hpp"

namespace plumb::offline::compare {

/// A range of one joint in which the error is larger than elsewhere, beyond chance.
struct WorstBand {
  int joint = 0;
  double from = 0.0, to = 0.0;  // [rad] or [m]
  double mean_m = 0.0, elsewhere_m = 0.0;
  std::vector<int> rows;  // the judged rows in it, worst first
};

/// The range of every joint is cut into eight equal steps. Returns the step whose mean error lies
/// most standard errors above that of the other poses; none if that is fewer than four, which is
/// exceeded by chance in about 1 % of all runs (Bonferroni over all steps).
/// Cost: joints * poses.
std::optional<WorstBand> worst_band(const Cell& cell, const Measurements& measured, const Fit& fit);

/// "The error is largest at J2 between 60 and 80 deg: 0.41 mm on average, 0.12 mm elsewhere; worst
/// at poses 12, 57 and 80.", or that no joint range stands out and which poses are the worst.
std::string where_sentence(const Cell& cell, const Measurements& measured, const Fit& fit);

}  // namespace plumb::offline::compare
