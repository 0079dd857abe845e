// SPDX-License-Identifier: Apache-2.0
#include "diagnose/left_over.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::offline {

std::optional<LeftOver> left_over(double mean_m, const NoiseFloor& floor, double coordinates,
                                  double parameters) {
  if (floor.source == NoiseFloor::Source::kNone || !(floor.mean_m > 0.0)) return std::nullopt;
  const double free = std::max(1.0, coordinates - parameters - 1.0);
  return LeftOver{mean_m / floor.mean_m, std::sqrt(1.0 + parameters / free)};
}

}  // namespace plumb::offline
