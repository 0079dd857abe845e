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

/// The waves of a candidate as they would be chosen without each fold of the fit poses, so that a
/// fold's error is held out from the choice of its frequencies as well: one list a fold, perhaps
/// empty. A wave of the grid that has been refined in `chosen` has that frequency.
/// Cost: as scan_ripples, and for each fold (waves on the grid)^2 for every wave that is picked.
std::vector<std::vector<double>> waves_without_folds(const Scorer& scorer, int joint,
                                                     const std::vector<double>& chosen,
                                                     double regressors);

/// Each of them scored at all poses, so that every fold can be predicted by the others.
std::vector<RegressorScore> scored_without_folds(const Scorer& scorer, int joint,
                                                 const std::vector<std::vector<double>>& waves);

}  // namespace plumb::offline
