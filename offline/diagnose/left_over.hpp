// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "fit/noise_floor.hpp"

namespace plumb::offline {

/// What a model leaves on poses that had no say, beside what the noise makes unavoidable.
struct LeftOver {
  double times = 0.0;        // noise floors
  double unavoidable = 1.0;  // what so few poses leave to a model that is right

  /// Clearly more: something is missing, named or not.
  bool lack_of_fit() const { return times > 1.3 * unavoidable; }
};

/// A model of p parameters, fitted to n coordinates with noise s, errs on others by
///
///   s sqrt(1 + p / (n - p - 1))
///
/// [Miller 2002, Subset selection in regression, 5.2: random x]. Nothing without a noise floor.
///
/// @param mean_m  Mean 3-D error of the poses that had no say, gross outliers left out [m].
std::optional<LeftOver> left_over(double mean_m, const NoiseFloor& floor, double coordinates,
                                  double parameters);

}  // namespace plumb::offline
