// SPDX-License-Identifier: Apache-2.0
#include "check/map_convention.hpp"

#include <algorithm>
#include <cmath>

#include "check/constants.hpp"
#include "check/unit_guess.hpp"

namespace plumb::offline {
namespace {

bool is_near(double factor, double expected, double within) {
  return std::abs(factor / expected - 1.0) < within;
}

/// Rounds to a multiple of 5, 1 or 0.5 deg within an arm's usual errors, else to 0.1 deg.
double round_angle(double angle) {
  const double degrees = angle * 180.0 / M_PI;
  for (const double step : {5.0, 1.0, 0.5})
    if (std::abs(degrees - step * std::round(degrees / step)) < check::kNearRound_deg)
      return step * std::round(degrees / step) * M_PI / 180.0;
  return 0.1 * std::round(degrees / 0.1) * M_PI / 180.0;
}

/// Rounds to a whole number or its reciprocal if that is near and unambiguous; keeps the sign.
double round_factor(double factor, double within) {
  const double size = std::abs(factor), sign = factor < 0.0 ? -1.0 : 1.0;
  const double whole = std::round(std::max(size, 1.0 / size));
  const double snapped = size < 1.0 ? 1.0 / whole : whole;
  if (within * whole > check::kOneWhole) within = check::kSameFactor;
  return is_near(size, snapped, within) ? sign * snapped : factor;
}

}  // namespace

Convention convention_of(const JointMap& map, const Convention& labels) {
  Convention c = labels;
  const double within = std::max(check::kSameFactor, check::kFactorDeviations * map.factor_std);
  for (std::size_t j = 0; j < map.zero.size(); ++j) {
    c.zero[j] = round_angle(map.zero[j]);
    if (map.factor[j] == 1.0) continue;
    for (const char* unit : {"rad", "deg", "mrad"})
      if (is_near(map.factor[j], unit_ratio(unit, labels.turn_unit), within)) c.own_unit[j] = unit;
    if (c.own_unit[j].empty()) c.factor[j] = round_factor(map.factor[j], within);
  }
  return c;
}

bool is_beyond_fit(const Convention& c) {
  for (std::size_t j = 0; j < c.zero.size(); ++j)
    if (std::abs(c.zero[j]) > check::kFitFindsZero || c.factor[j] != 1.0 || !c.own_unit[j].empty())
      return true;
  return false;
}

}  // namespace plumb::offline
