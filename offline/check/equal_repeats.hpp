// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/measurements.hpp"
#include "fit/noise_floor.hpp"

namespace plumb::offline {

/// How many repeats of a pose show the very digits of another one because the file was rounded.
struct EqualRepeats {
  double points = 0.0;   // readings that are expected to agree in the point
  double rows = 0.0;     // and in all joint positions
  bool assumed = false;  // nothing in the files tells the noise, so that of a good tracker is used
  double step_m = 0.0;   // coarsest step of the measured axes; 0 if they are not rounded
};

/// How often single coordinates of two repeats agree, although not all of them do, tells how often
/// all of them do by chance: rounding treats each axis by itself. That needs five pairs of repeats
/// that differ. With fewer, the steps of the files and the noise tell it: of two readings with
/// normal noise sigma, rounded to steps s, both have the same coordinate with probability
/// erf(u) - (1 - exp(-u^2)) / (u sqrt(pi)), u = s / (2 sigma).
/// Cost: O(n).
EqualRepeats equal_by_rounding(const MeasurementFiles& measured, const NoiseFloor& floor);

/// The most that chance makes of an expected number of equal readings.
double most_by_chance(double expected);

}  // namespace plumb::offline
