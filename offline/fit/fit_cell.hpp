// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/fit.hpp"

namespace plumb::offline {

/// Splits, calibrates, learns the tree, and measures the held-out error. The held-out poses do not
/// take part in any choice of the model. Throws Failure as `calibrate` and `split_poses` do.
///
/// @param tell  Called before every step if there are folds, with "step 2 of 6, fold 1".
Fit fit_cell(const Cell& cell, const Measurements& measured,
             const std::function<void(const std::string&)>& tell = {});

/// The final model fitted to every pose that is not ignored; it has no held-out error.
Fit fit_all(const Cell& cell, const Measurements& measured);

}  // namespace plumb::offline
