// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cell/measurements.hpp"
#include "fit/split.hpp"

/// What few poses leave even to a model that is right. Whether more than that is left says
/// fit/left_over.hpp.
namespace plumb::offline {

/// Readings in the smallest set that any fit of the split gets. With folds, each leaves one out.
std::size_t fewest_fitted(const Split& split);

/// Coordinates of distinct poses that each fit of the split sees, on average over its folds. A
/// repeat of a pose tells of the noise, not of the arm, and does not count.
double fitted_coordinates(const Measurements& measured, const Split& split);

/// A model of p parameters, fitted to n coordinates with noise s, errs on others by
///
///   s sqrt(1 + p / (n - p - 1))
///
/// [Miller 2002, Subset selection in regression, 5.2: random x]. That, over s.
double error_growth(double coordinates, double parameters);

/// How many times the noise an arm that is right may miss poses it has not seen: the growth above,
/// times what chance may add. The mean square of d = n - p - 1 free coordinates is known to
/// sqrt(2 / d); two of these are allowed.
double unavoidable_ratio(double coordinates, double parameters);

}  // namespace plumb::offline
