// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/scan.hpp"

namespace plumb::offline {

/// Effects chosen one after another, each on what those before it leave, without a refit.
struct Explanation {
  std::vector<Found> effects;
  double score = 0.0;        // sum of the scores of the effects
  double times_noise = 1.0;  // mean square that they leave, over that of the noise
};

/// The first choice of a forward selection may be one wrong effect in the place of two right ones.
/// At the whitened fit without `chosen` (a key), effects that explain nearly as much are followed
/// further, and so is the chosen one; returns the best explanation without it that leaves only
/// noise, if it is better by a clear margin. Cost: some ten scans.
std::optional<Explanation> better_explanation(const WhitenedFit& whitened, const Scan& look,
                                              const std::string& chosen,
                                              const std::vector<std::string>& not_testable,
                                              const std::vector<std::string>& banned);

}  // namespace plumb::offline
