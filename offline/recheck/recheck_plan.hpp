// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "recheck/visible.hpp"
#include "runs/run.hpp"

namespace plumb::offline::recheck {

/// Few poses of the calibration that, measured again, tell best what has changed. They are better
/// than new poses, because the error of the model at them is known.
struct RecheckPlan {
  std::vector<int> rows;            // of the measurements, in their order
  std::vector<Visibility> visible;  // the changes that they would show, and from which size on
};

/// D-optimal among the measured poses for all changes together [Fedorov 1972], each with its
/// typical size as prior: the poses that leave least room for any of them. `calibrated` and `run`
/// as in `recheck_run`. Fewer rows than `n` if there are not so many different poses.
/// Cost: n * poses * numbers^2.
RecheckPlan plan_recheck(const Cell& cell, const Run& calibrated, const Run& run,
                         const Measurements& own, int n);

}  // namespace plumb::offline::recheck
