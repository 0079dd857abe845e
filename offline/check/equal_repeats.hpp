// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/measurements.hpp"
#include "noise/noise_floor.hpp"

namespace plumb::offline {

/// How many repeats of a pose are expected to equal another one because the file is rounded.
struct EqualRepeats {
  double points = 0.0;   // expected number of readings that agree in the point
  double rows = 0.0;     // expected number that agree in all joint positions too
  bool assumed = false;  // the noise is unknown, so that of a good tracker is assumed
  double step_m = 0.0;   // coarsest step of the measured axes; 0 if they are not rounded
};

/// Estimated from the pairs of repeats that differ: how often they agree in single coordinates
/// tells how often all coordinates agree by chance, as each axis is rounded independently. This
/// needs five such pairs. With fewer, the rounding steps and the noise are used: two readings with
/// normal noise sigma, rounded to steps s, have the same coordinate with probability
///
///   erf(u) - (1 - exp(-u^2)) / (u sqrt(pi)),  u = s / (2 sigma)
///
/// Cost: O(n).
EqualRepeats equal_by_rounding(const MeasurementFiles& measured, const NoiseFloor& floor);

/// Upper limit of the number of equal readings by chance, if `expected` are expected.
double most_by_chance(double expected);

}  // namespace plumb::offline
