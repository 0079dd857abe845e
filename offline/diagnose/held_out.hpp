// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/regressor.hpp"
#include "diagnose/regressor_score.hpp"
#include "fit/error_stats.hpp"

namespace plumb::offline {

/// 3-D error on poses that were not fitted, to first order: on the held-out poses of the whitened
/// fit, or if there are none, by cross-validation over its folds.
ErrorStats held_out_error(const Scorer& scorer);

/// The same with a regressor in the model.
ErrorStats held_out_error(const Scorer& scorer, const Regressor& regressor,
                          const RegressorScore& scored);

/// How far the 3-D error falls with the regressor, by cross-validation over the folds.
Gain held_out_gain(const Scorer& scorer, const Regressor& regressor, const RegressorScore& scored);

}  // namespace plumb::offline
