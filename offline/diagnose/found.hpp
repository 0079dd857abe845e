// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/move.hpp"
#include "diagnose/regressor.hpp"
#include "diagnose/regressor_score.hpp"

namespace plumb::offline {

/// One candidate of a scan: the best of an effect at a joint over its non-linear numbers.
struct Found {
  EffectEntry entry;
  Pattern pattern;
  RegressorScore scored;
  Gain gain;                     // of what could be chosen; else zero
  double score = 0.0;            // ln B less ln of the number of regressors tried
  std::vector<double> cycles;    // of ripple: all its waves, strongest first
  double rms_joint = 0.0;        // of a pattern at a joint: its fitted size [rad]
  std::string peaks = {};        // of a series: its largest waves in words
  std::string sizes = {};        // of a series of all joints: the error of each in words
  std::vector<Move> moves = {};  // of a part that moved several times: all of them, in order
  double ln_bayes() const { return scored.evidence.ln_bayes; }

  /// As it would stand in the cell: every wave of a ripple is an entry, and every move of a part.
  std::vector<EffectEntry> entries() const;
};

/// The columns of a candidate of the library.
Regressor regressor_of(const WhitenedFit& whitened, const Found& found);

/// "gear_ripple:J2": effect and joints.
std::string key_of(const Cell& cell, const EffectEntry& entry);

}  // namespace plumb::offline
