// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
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
  std::vector<Move> moves = {};  // of a part that moved several times: all of them, in order
  double ln_bayes() const { return scored.evidence.ln_bayes; }

  /// As it would stand in the cell: every wave of a ripple is an entry, and every move of a part.
  std::vector<EffectEntry> entries() const;
};

/// The columns of a candidate of the library.
Regressor regressor_of(const WhitenedFit& whitened, const Found& found);

/// One look at a whitened fit with the whole library and the generic patterns.
struct Scan {
  std::vector<Found> library;    // by ln B, best first; gains known wherever score > kSupported
  std::optional<Found> pattern;  // the best one
  std::optional<Found> slow;     // the best of those that move slowly; with its gain
  double regressors = 0.0;       // tried

  /// First of the library that evidence and held-out poses support, and `also` lets pass; or null.
  const Found* supported(const std::function<bool(const Found&)>& also = {}) const;
  /// The one of that key (see key_of), or null.
  const Found* find(const Cell& cell, const std::string& key) const;
  /// Whether the best pattern leaves the library's best far behind.
  bool unknown() const;
};

/// `banned`: keys (see key_of) of what is not to be tried.
Scan scan(const WhitenedFit& whitened, const std::vector<std::string>& not_testable,
          const std::vector<std::string>& banned);

/// "gear_ripple:J2": effect and joints.
std::string key_of(const Cell& cell, const EffectEntry& entry);

}  // namespace plumb::offline
