// SPDX-License-Identifier: Apache-2.0
#include "fit/few_poses.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "fit/constants.hpp"

namespace plumb::offline {
namespace {

/// n - p - 1, at least 1.
double free_coordinates(double coordinates, double parameters) {
  return std::max(1.0, coordinates - parameters - 1.0);
}

}  // namespace

std::size_t fewest_fitted(const Split& split) {
  std::size_t out = fit_rows(split).size();
  for (int fold = 0; fold < split.folds; ++fold) out = std::min(out, fit_rows(split, fold).size());
  return out;
}

double fitted_coordinates(const Measurements& measured, const Split& split) {
  std::set<int> poses;
  for (const int row : fit_rows(split)) poses.insert(measured.replicate_group[row]);
  const double inside = split.folds > 0 ? 1.0 - 1.0 / split.folds : 1.0;
  return inside * measured.mean_axes() * static_cast<double>(poses.size());
}

double error_growth(double coordinates, double parameters) {
  return std::sqrt(1.0 + parameters / free_coordinates(coordinates, parameters));
}

double unavoidable_ratio(double coordinates, double parameters) {
  const double by_chance =
      kAllowedSigma * std::sqrt(2.0 / free_coordinates(coordinates, parameters));
  return error_growth(coordinates, parameters) * std::sqrt(1.0 + by_chance);
}

}  // namespace plumb::offline
