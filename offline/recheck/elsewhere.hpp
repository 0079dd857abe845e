// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline::recheck {

/// Distance of two poses in the space of the joints [rad], or [m] of a sliding joint; 0 if one of
/// them is the other one driven to again.
double pose_distance(const Measurements& a, int i, const Measurements& b, int j);

/// Which of the readings lie where the calibration had no pose: farther from the nearest one than
/// nearly all of its poses are from their neighbours. What the model lacks there has never shown.
///
/// @param known  Rows of `own` that the calibration was fitted to.
/// @return shape (rows,). Cost: kMostNear times the poses of the calibration.
std::vector<bool> elsewhere(const Measurements& own, const std::vector<int>& known,
                            const Measurements& rows);

}  // namespace plumb::offline::recheck
