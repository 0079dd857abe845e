// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Throws Failure (kNumbersSayNo) if no fit is possible: E-FIT-FEW if every row is held out,
/// E-FIT-ONE-POSE if the poses of `rows` are nearly all the same.
void check_poses(const Measurements& measured, const std::vector<int>& rows);

/// Names of the joints that have the same position in all of these rows.
std::vector<std::string> still_joints(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows);

}  // namespace plumb::offline
