// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Set-ups that are said to stand where another one stands, or to carry its reflector, and do not
/// (W-CHECK-SAME, with the distance): the error would otherwise look like one of the arm. Said if
/// the fit with a frame or reflector of its own leaves less than half of the error.
/// Cost: one calibration of 600 rows, and one more for each frame and reflector that is shared.
std::vector<Problem> sharing_findings(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows);

}  // namespace plumb::offline
