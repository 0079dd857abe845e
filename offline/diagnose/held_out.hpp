// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/regressor.hpp"
#include "diagnose/regressor_score.hpp"
#include "noise/error_stats.hpp"

namespace plumb::offline {

/// Errors of poses that were not fitted.
struct HeldOutError {
  ErrorStats points;  // 3-D [m], without single bad readings
  ErrorStats turns;   // angles [rad]; n = 0 where the fit uses no orientations
};

/// The error on poses that were not fitted, to first order: on the
/// held-out poses of the whitened fit, or if there are none, by cross-validation over its folds.
HeldOutError held_out_error(const Scorer& scorer);

/// A candidate as each fold has it: the same everywhere, but of waves the frequencies that the
/// other folds choose.
struct CandidateInFolds {
  std::vector<Regressor> regressor;
  std::vector<RegressorScore> scored;
};

/// The error with a regressor in the model.
///
/// @param in_folds  What is added in each fold; without columns: nothing.
HeldOutError held_out_error(const Scorer& scorer, const Regressor& regressor,
                            const RegressorScore& scored, const CandidateInFolds& in_folds);

/// How far the error falls with it, orientations counted in their sigmas, by cross-validation over
/// the folds.
Gain held_out_gain(const Scorer& scorer, const CandidateInFolds& in_folds);

/// Whether points or orientations show a candidate each by itself: the held-out error of the points
/// falls by more than one standard error of the folds, or that of the orientations clearly while
/// the points do not speak against it. Else orientations show something that is no motion of the
/// arm: errors of their own, which repeats need not show.
bool shown_by_points_or_turns(const Scorer& scorer, const Regressor& regressor,
                              const RegressorScore& scored);

}  // namespace plumb::offline
