// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/calibration.hpp"
#include "noise/noise_floor.hpp"

namespace plumb::offline {

/// Joint readings beyond their limits (W-CHECK-LIMITS, first rows with their lines), saying so if a
/// whole turn less would be inside. Only a warning, because fit uses no limits. Beyond limits that
/// were only assumed: N-CHECK-LIMITS.
std::vector<Problem> limit_findings(const Cell& cell, const MeasurementFiles& measured);

/// Readings that the others contradict (W-CHECK-OUTLIER), farthest first, with their lines, and
/// where neighbouring ones are off by one vector.
std::vector<Problem> outlier_findings(const MeasurementFiles& measured,
                                      const Calibration& calibration);

/// Context columns that hold one value only (N-CHECK-CONSTANT), and joints that never move.
std::vector<Problem> constant_findings(const Cell& cell, const MeasurementFiles& measured);

/// Repeats that scatter by far more or far less than the stated noise (W-CHECK-REPEATS).
std::vector<Problem> repeat_findings(const Cell& cell, const NoiseFloor& floor);

}  // namespace plumb::offline
