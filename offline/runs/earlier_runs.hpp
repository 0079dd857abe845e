// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "runs/run.hpp"

namespace plumb::offline {

/// Whether a run was made from exactly these files.
bool is_of_data(const Run& run, const MeasurementFiles& measured);

/// Whether a run is of the present cell and data, as run.json says, before the poses of any are
/// read.
bool seems_fitted(const Cell& cell, const MeasurementFiles& measured);

/// Runs before this one that are of the same data and can be read, oldest first: the steps by which
/// a model may have grown. Cost: every run before it is read.
std::vector<Run> earlier_runs(const Run& last, const Cell& cell, const MeasurementFiles& measured);

/// Rechecks of this calibration, and of its rechecks, that can be read, oldest first. Cost: every
/// run after it is read.
std::vector<Run> rechecks_of(const Run& calibrated, const Cell& cell);

}  // namespace plumb::offline
