// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "effects/effect_entry.hpp"
#include "noise/error_stats.hpp"

namespace plumb::offline {

/// A fitted number of a formula. SI.
struct FormulaNumber {
  std::string name, unit;  // "k1", "1"
  double value = 0.0, std = 0.0;
};

/// A point of the curve of a formula: its first input, and what it moves. SI.
struct FormulaSample {
  double input = 0.0, value = 0.0;
};

/// A law that a diagnosis offers for structure that no law of the library explains; errors in [m],
/// of poses that were not fitted.
struct FormulaOffer {
  EffectEntry entry;  // as it would stand in the cell
  std::vector<FormulaNumber> numbers;
  ErrorStats before, after;          // held out: without it, and with it
  double fall_m = 0.0;               // of the mean error, pose by pose
  double fall_se_m = 0.0;            // standard error of that
  double nats = 0.0;                 // held-out evidence, its numbers paid for
  bool turns = true;                 // what it moves turns [rad]; false: it shifts [m]
  std::string input, input_unit;     // of the curve: "q4", "rad"
  std::vector<FormulaSample> curve;  // along that input, the others at their middle
};

}  // namespace plumb::offline
