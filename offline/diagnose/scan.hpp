// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/found.hpp"

namespace plumb::offline {

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

}  // namespace plumb::offline
