// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cell/measurements.hpp"
#include "fit/split.hpp"

/// The error that a correct model has on unseen poses if it was fitted to few of them.
/// fit/held_out_excess.hpp tells whether a model has more than that.
namespace plumb::offline {

/// Number of readings of the smallest fit of the split. With folds, each fit leaves one fold out.
std::size_t fewest_fitted(const Split& split);

/// Coordinates of distinct poses that each fit of the split sees, on average over its folds. A
/// repeat of a pose tells of the noise, not of the arm, and does not count.
double fitted_coordinates(const Measurements& measured, const Split& split);

/// A model of p parameters, fitted to n coordinates with noise s, errs on others by
///
///   s sqrt(1 + p / (n - p - 1))
///
/// [Miller 2002, Subset selection in regression, 5.2: random x]. Returns this divided by s.
double error_growth(double coordinates, double parameters);

/// The largest error on unseen poses, over that of noise alone, that is compatible with a correct
/// model: the growth above, times the scatter that is allowed for. The relative standard deviation
/// of a mean square of d = n - p - 1 free coordinates is sqrt(2 / d); two of these are allowed.
double unavoidable_ratio(double coordinates, double parameters);

}  // namespace plumb::offline
