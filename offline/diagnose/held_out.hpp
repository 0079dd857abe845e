// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/regressor.hpp"
#include "diagnose/regressor_score.hpp"
#include "fit/error_stats.hpp"

namespace plumb::offline {

/// 3-D error on poses that had no say, to first order: the whitened fit's held-out poses, or where
/// there are none, each fold by the others.
ErrorStats held_out_error(const Scorer& scorer);

/// The same with a regressor in the model.
ErrorStats held_out_error(const Scorer& scorer, const Regressor& regressor,
                          const RegressorScore& scored);

}  // namespace plumb::offline
