// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "program/outcome.hpp"
#include "runs/run.hpp"
#include "show/runs_view.hpp"

/// The steps with which most verbs begin: find the cell of -C, read its measurements, get a run.
namespace plumb::offline::cli {

/// The cell.toml of -C, or the nearest one upward. Throws Failure (kInput, E-CELL-NONE).
std::filesystem::path cell_file(const Globals& globals);

/// What of a cell's own files a verb makes; the others are kept from its outputs (refuse_kept).
enum class Makes : std::uint8_t { kNone, kMeasurements, kModel };

/// The cell of -C, or the nearest one upward; its file and remarks go to `outcome`.
Cell open_cell(const Globals& globals, Outcome& outcome, Makes makes = Makes::kNone);

/// Keeps the files of this cell from the outputs of a verb.
void keep_files(const Cell& cell, Makes makes, Outcome& outcome);

/// The same of the cells that a verb does not read: that of -C, or the nearest one upward, and the
/// one in whose folder the output lies. `output` may be empty.
void keep_cells_around(const Globals& globals, const std::filesystem::path& output,
                       Outcome& outcome);

/// The cell's measurements; files and remarks go to `outcome`.
MeasurementFiles open_measurements(Cell& cell, Outcome& outcome);

/// Joint rows of another file, for this cell's arm or a model's.
MeasurementFiles open_rows(const std::filesystem::path& file, const format::Chain& chain,
                           Outcome& outcome);

/// Fits, with progress and remarks.
Fit fit_with_progress(const Cell& cell, const MeasurementFiles& measured, Outcome& outcome);

/// Keeps the fit as the next run.
Run keep(const Cell& cell, const MeasurementFiles& measured, Fit fit);

/// Keeps with a run the noise floor that a diagnosis of its model found.
void keep_floor(const Cell& cell, const Run& run, const NoiseFloor& floor);

/// Whether a run that is made is kept; one that is not has number 0.
enum class Keep { kRun, kNothing };

/// The latest run of the present cell and data; if there is none, fits one, and says so.
Run current_or_new_run(const Cell& cell, const MeasurementFiles& measured, Keep keep_it,
                       Outcome& outcome);

/// Puts the measurements on the base of the run, which is what its corrections are added to: the
/// positions of the arm as the cell describes it, or those that the controller reported.
void stand_on_base_of(const Run& run, const Cell& cell, MeasurementFiles& measured);

/// Refuses (E-RUN-BASE) a run based on positions of the controller that differ from those of the
/// cell's arm, because plumb-rt knows only the arm of the cell. `measured` is on the base of the
/// run.
void check_known_to_runtime(const Run& run, const MeasurementFiles& measured);

/// Whether a run is of the present cell file and data.
show::ListedRun::State state_of(const Run& run, const Cell& cell, const MeasurementFiles& measured);

/// Refuses (E-RUN-DATA) a run that was made from other measurements than these.
void check_same_data(const Run& run, const MeasurementFiles& measured);

}  // namespace plumb::offline::cli
