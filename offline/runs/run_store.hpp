// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "runs/run.hpp"

namespace plumb::offline {

/// The run that `save_run` would keep, not kept: number 0.
Run draft_run(const Cell& cell, const MeasurementFiles& measured, Fit fit);

/// Writes the next run; all or nothing.
Run save_run(const Cell& cell, const MeasurementFiles& measured, Fit fit);

/// The same of a recheck; `measured` are its readings.
Run save_recheck(const Cell& cell, const MeasurementFiles& measured, Fit fit, RecheckOf recheck);

/// Keeps the noise floor that a diagnosis of the model of a kept run found, with the scatter of the
/// joints in it: from then on it is the floor of this run.
void save_floor(const Run& run, const NoiseFloor& floor);

/// That floor; nothing if the model was never diagnosed.
std::optional<NoiseFloor> diagnosed_floor(const Run& run);

/// The number of every run, oldest first, whether it can be read or not.
std::vector<int> list_runs(const Cell& cell);

/// Throws Failure (kInput) if there is no such run or a file of it was edited or cut off.
Run load_run(const Cell& cell, int number);

/// Whether the run was made of what a fit reads of this cell.
bool is_of_cell(const Run& run, const Cell& cell);

/// The latest run of the present cell and data, rechecks not counted. Throws on a damaged later
/// one: was it that?
std::optional<Run> current_run(const Cell& cell, const MeasurementFiles& measured);

/// Whether a run is a recheck of one of these; then its number is added to them.
bool joins_line(const Run& later, std::vector<int>& line);

/// What is known of the arm now: the latest recheck that goes back to this run, or the run itself.
/// Throws on a damaged later one.
Run latest_recheck(const Cell& cell, Run run);

/// The latest recheck that found the arm changed and that this run does not go back to, though both
/// go back to the same readings of a calibration: the run is of the arm before. Damaged runs
/// are passed over.
std::optional<Run> left_out_recheck(const Cell& cell, const Run& run);

/// The calibration that a recheck goes back to; a run that is no recheck is returned as it is.
Run calibrated_run(const Cell& cell, Run run);

}  // namespace plumb::offline
