// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/regressor_score.hpp"

namespace plumb::offline {

/// The waves of one joint that explain most together.
struct Ripples {
  int joint = 0;
  std::vector<double> cycles;       // a turn, strongest first
  double strongest_ln_bayes = 0.0;  // of the first alone, on the grid
};

/// Picks waves of a joint one after the other, each given those before, while each one's own
/// evidence pays for the search through `regressors` of them; the first is always picked.
/// Frequencies are then refined. `tried` grows by the waves on the grid. Cost: poses * (waves on
/// the grid)^2.
Ripples scan_ripples(const Scorer& scorer, int joint, double regressors, int& tried);

/// The best single wave of a joint beyond those of the usual scan, refined. Fast waves are rare,
/// and trying them costs as much as the rest of a scan: use it if nothing else explains what is
/// left. Cost: poses * waves on the grid * (rank + 32).
Ripples scan_fast_ripples(const Scorer& scorer, int joint, int& tried);

}  // namespace plumb::offline
