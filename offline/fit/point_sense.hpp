// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/calibration.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// What is wrong with touched points, by what the calibrated arm leaves of them: W-FIT-LENGTH, a
/// stated distance contradicts the other readings; W-FIT-POINT-SAME, two labels are one point;
/// W-FIT-POINT-MOVED, a point moved from some row on. `fitted`: the rows of the fit, in their
/// order. Cost: one prediction of each row.
std::vector<Problem> point_remarks(const MeasurementSettings& settings, const Measurements& fitted,
                                   const Calibration& calibration);

}  // namespace plumb::offline
