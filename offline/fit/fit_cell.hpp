// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/fit.hpp"

namespace plumb::offline {

/// Splits, calibrates, learns the tree, and measures the held-out error. The held-out poses are
/// never seen by selection. Throws Failure as `calibrate` and `split_poses` do.
///
/// @param tell  Is told of every step when there are folds: "step 2 of 6, fold 1".
Fit fit_cell(const Cell& cell, const Measurements& measured,
             const std::function<void(const std::string&)>& tell = {});

/// Final model on every pose; carries no held-out figure.
Fit fit_all(const Cell& cell, const Measurements& measured);

}  // namespace plumb::offline
