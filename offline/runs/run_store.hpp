// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "runs/run.hpp"

namespace plumb::offline {

/// The run that `save_run` would store, without storing it; its number is 0.
Run draft_run(const Cell& cell, const MeasurementFiles& measured, Fit fit);

/// Stores the next run. Either all of its files are written or none.
Run save_run(const Cell& cell, const MeasurementFiles& measured, Fit fit);

/// Stores a recheck; `measured` are its new readings.
Run save_recheck(const Cell& cell, const MeasurementFiles& measured, Fit fit, RecheckOf recheck);

/// Stores the noise floor that a diagnosis of the model of a stored run found, including the floor
/// that the scatter of the joints implies. `load_run` takes the latter over.
void save_floor(const Run& run, const NoiseFloor& floor);

/// The floor that `save_floor` stored; nothing if the model was never diagnosed.
std::optional<NoiseFloor> diagnosed_floor(const Run& run);

/// The numbers of all runs, oldest first, including those that cannot be read.
std::vector<int> list_runs(const Cell& cell);

/// Reads a run. Throws Failure (kInput) if there is no such run, or if one of its files was edited
/// or cut off.
Run load_run(const Cell& cell, int number);

/// Whether the run was made from this cell: everything that a fit reads of cell.toml is unchanged.
bool is_of_cell(const Run& run, const Cell& cell);

/// The latest run of the present cell and data that is no recheck. Throws Failure (kInput) if a
/// later run is damaged, because that may be the latest one.
std::optional<Run> current_run(const Cell& cell, const MeasurementFiles& measured);

/// Whether `later` is a recheck of one of the runs with these numbers; its number is then added to
/// them.
bool joins_line(const Run& later, std::vector<int>& line);

/// The latest model of the arm: the last recheck that goes back to this run, or the run itself.
/// Throws Failure (kInput) if a later run is damaged.
Run latest_recheck(const Cell& cell, Run run);

/// The latest recheck that found the arm changed but that `run` does not go back to, although both
/// go back to the same readings of a calibration. If there is one, `run` describes the arm before
/// the change. Damaged runs are passed over.
std::optional<Run> left_out_recheck(const Cell& cell, const Run& run);

/// The calibration that a recheck goes back to. A run that is no recheck is returned unchanged.
Run calibrated_run(const Cell& cell, Run run);

}  // namespace plumb::offline
