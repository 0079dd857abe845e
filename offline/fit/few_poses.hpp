// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cell/measurements.hpp"
#include "fit/split.hpp"

/// The error that a correct model has on unseen poses if it was fitted to few of them.
/// fit/held_out_excess.hpp decides whether the error of a model exceeds it.
namespace plumb::offline {

/// Number of readings of the smallest fit of the split, since with folds each fit leaves one out.
std::size_t fewest_fitted(const Split& split);

/// Number of coordinates of distinct poses in a fit of the split, on average over its folds.
/// Repeats of a pose do not count: they show the noise, not the arm.
double fitted_coordinates(const Measurements& measured, const Split& split);

/// A model of p parameters, fitted to n coordinates with noise s, has on others an error of
///
///   s sqrt(1 + p / (n - p - 1))
///
/// [Miller 2002, Subset selection in regression, 5.2: random x]. Returns this divided by s.
double error_growth(double coordinates, double parameters);

/// The largest error on unseen poses, over that of noise alone, that is compatible with a correct
/// model: the growth above times an allowance for its sampling error. A mean square of
/// d = n - p - 1 free coordinates has a relative standard deviation of sqrt(2 / d); two of these
/// are allowed.
double unavoidable_ratio(double coordinates, double parameters);

}  // namespace plumb::offline
