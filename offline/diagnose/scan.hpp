// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/block.hpp"
#include "diagnose/trial.hpp"

namespace plumb::offline {

/// One candidate of a scan: the best of an effect at a joint over its non-linear numbers.
struct Found {
  EffectEntry entry;
  Pattern pattern;
  Trial trial;
  Gain gain;                   // of what could be chosen; else zero
  double score = 0.0;          // ln B less ln of the number of blocks tried
  std::vector<double> cycles;  // of ripple: all its waves, strongest first
  double rms_joint = 0.0;      // of a pattern at a joint: its fitted size [rad]
  double ln_bayes() const { return trial.evidence.ln_bayes; }

  /// As it would stand in the cell: every wave of a ripple is an entry.
  std::vector<EffectEntry> entries() const;
};

/// The columns of a candidate of the library.
Block block_of(const Stage& stage, const Found& found);

/// One look at a stage with the whole library and the generic patterns.
struct Scan {
  std::vector<Found> library;    // by ln B, best first; gains known wherever score > kSupported
  std::optional<Found> pattern;  // the best one
  double blocks = 0.0;           // tried

  /// First of the library that evidence and held-out poses support, and `also` lets pass; or null.
  const Found* supported(const std::function<bool(const Found&)>& also = {}) const;
  /// The one of that key (see key_of), or null.
  const Found* find(const Cell& cell, const std::string& key) const;
  /// Whether the best pattern leaves the library's best far behind.
  bool unknown() const;
};

inline constexpr double kSupported = 3.0;    // nats
inline constexpr double kAhead_nats = 10.0;  // of one explanation over another: clearly

/// `banned`: keys (see key_of) of what is not to be tried.
Scan scan(const Stage& stage, const std::vector<std::string>& not_testable,
          const std::vector<std::string>& banned);

/// "gear_ripple:J2": effect and joints.
std::string key_of(const Cell& cell, const EffectEntry& entry);

}  // namespace plumb::offline
