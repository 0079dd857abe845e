// SPDX-License-Identifier: Apache-2.0
#include "solve/predictions_at_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solve/constants.hpp"

namespace plumb::offline {
namespace {

/// RMS motion of the predictions, in standard deviations of the noise, that corresponds to a fall
/// of the cost near its minimum.
double motion_of(double cost_fall, double cost, int residuals) {
  const double n = std::max(1, residuals);
  const double scatter = std::max(1.0, std::sqrt(2.0 * cost / n));
  return std::sqrt(2.0 * std::max(0.0, cost_fall) / n) / scatter;
}

}  // namespace

bool PredictionsAtRest::may_end() const {
  return costs_.size() > kRestPatience && recent_motion() < kAtRest;
}

bool PredictionsAtRest::nearly() const { return recent_motion() < kNearlyAtRest; }

double PredictionsAtRest::recent_motion() const {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  if (costs_.size() <= kRestLookBack) return unknown;
  const double fall = costs_[costs_.size() - 1 - kRestLookBack] - costs_.back();
  return std::isfinite(fall) ? motion_of(fall, costs_.back(), residuals_) : unknown;
}

}  // namespace plumb::offline
