// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// The error that measurement noise alone would cause, whatever the model: measured by repeats, or
/// stated. A floor that is only inferred from residuals stands beside it and never replaces it.
struct NoiseFloor {
  double sigma_m = 0.0;  // 1 sigma per axis
  double mean_m = 0.0;   // mean error: 1.596 sigma with three axes, 1.253 with two
  double rms_m = 0.0;    // sqrt(axes) sigma
  int dof = 0;           // degrees of freedom of the repeats; 0: sigma is stated
  enum class Source { kNone, kRepeats, kSigma } source = Source::kNone;
  double inferred_m = 0.0;  // mean error if the residuals are scatter of the joints, as a diagnosis
                            // infers it; 0: it infers none

  double inferred_times() const { return inferred_m > mean_m ? inferred_m / mean_m : 1.0; }
};

/// Mean of the chi distribution: the mean length of a normal vector with 1 sigma about each axis,
/// in sigmas. For one to three axes.
double mean_norm(int axes);

/// "noise floor 0.016 mm", of a stated sigma "noise floor 0.016 mm of the stated sigma".
std::string floor_words(const NoiseFloor& floor);

/// Degrees of freedom of the floor: those of the repeats, or 4 of a stated sigma, which is right to
/// some 35 %; 0 if the floor is unknown.
double trusted_dof(const NoiseFloor& floor);

/// From repeats of a pose if they have at least five degrees of freedom, else from the stated
/// sigma. Only repeats under one context count: see repeat_groups.hpp. Readings that miss the
/// others of their pose by more than six times the usual scatter are bad readings and no noise;
/// readings equal to the last digit are copies and no repeats. Repeats within a tenth of all rows
/// from each other are preferred if there are enough of them, because a difference between the
/// beginning and the end may be drift.
NoiseFloor noise_floor(const Cell& cell, const Measurements& measured);

/// The same from the residuals of a model. Repeats before and after a drift or a bump of the
/// reflector, say, show the noise only if the model includes it.
NoiseFloor noise_floor(const Cell& cell, const Measurements& measured, const ArmState& model);

}  // namespace plumb::offline
