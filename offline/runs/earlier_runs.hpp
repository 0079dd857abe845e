// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "runs/run.hpp"

namespace plumb::offline {

/// Whether a run was made from exactly these files.
bool is_of_data(const Run& run, const MeasurementFiles& measured);

/// Whether there seems to be a run of the present cell and data. Reads only run.json of each run,
/// and neither its predictions nor its check sums.
bool seems_fitted(const Cell& cell, const MeasurementFiles& measured);

/// The readable runs of the same data before `last`, oldest first, by which the model may have
/// grown. Cost: reads every run before it.
std::vector<Run> earlier_runs(const Run& last, const Cell& cell, const MeasurementFiles& measured);

/// The readable rechecks of this calibration and of its rechecks, oldest first. Cost: reads every
/// run after it.
std::vector<Run> rechecks_of(const Run& calibrated, const Cell& cell);

}  // namespace plumb::offline
