// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// What noise alone would leave of the error, whatever the model: measured by repeats, or stated.
/// What is only inferred from what a model leaves stands beside it and never in its place.
struct NoiseFloor {
  double sigma_m = 0.0;  // 1 sigma per axis
  double mean_m = 0.0;   // mean error: 1.596 sigma with three axes, 1.253 with two
  double rms_m = 0.0;    // sqrt(axes) sigma
  int dof = 0;           // repeated coordinates behind it; 0: sigma as stated
  enum class Source { kNone, kRepeats, kSigma } source = Source::kNone;
  double inferred_m = 0.0;  // mean error if what the model leaves is scatter of the joints, as a
                            // diagnosis takes it for; 0: it sees none

  double inferred_times() const { return inferred_m > mean_m ? inferred_m / mean_m : 1.0; }
};

/// "noise floor 0.016 mm", of a stated sigma "noise floor 0.016 mm of the stated sigma".
std::string floor_words(const NoiseFloor& floor);

/// Degrees of freedom with which the floor is believed: those of the repeats; a stated sigma is
/// good to some 35 %, which is 4 of them; 0 where nothing is known.
double trusted_dof(const NoiseFloor& floor);

/// From repeats of a pose if there are at least five degrees of freedom, else from the stated
/// sigma. Only repeats under one context count: see repeat_groups.hpp. Readings that contradict the
/// others of their pose, by six times the usual scatter, are bad readings and no noise; those equal
/// to the last digit are copies and no repeats. Repeats that follow soon upon each other count,
/// within a tenth of all rows if there are enough of those: what differs between the beginning and
/// the end is drift.
NoiseFloor noise_floor(const Cell& cell, const Measurements& measured);

/// The same of what a model leaves of the readings: repeats that a drift or a bumped reflector lies
/// between tell of noise only once the model knows of it.
NoiseFloor noise_floor(const Cell& cell, const Measurements& measured, const ArmState& model);

}  // namespace plumb::offline
