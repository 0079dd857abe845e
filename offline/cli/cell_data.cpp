// SPDX-License-Identifier: Apache-2.0
#include "cli/cell_data.hpp"

#include <fmt/format.h>

#include "cell/earlier_arm.hpp"
#include "cell/measurement_reader.hpp"
#include "cell/setups.hpp"
#include "cli/cell_lock.hpp"
#include "cli/progress.hpp"
#include "fit/cell_data.hpp"
#include "fit/controller_base.hpp"
#include "fit/fit_cell.hpp"
#include "program/file.hpp"
#include "program/interrupt.hpp"
#include "runs/earlier_runs.hpp"
#include "runs/run_store.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kAsGoodAsTheArm_m = 50e-6;  // tolerance of plumb-rt for poses of the controller

void note_tables(const MeasurementFiles& measured, Outcome& outcome) {
  for (const auto& table : measured.tables) {
    outcome.inputs.push_back({table.file, table.sha256});
    outcome.remark(table.remarks);
  }
}

}  // namespace

fs::path cell_file(const Globals& globals) {
  // With -C only that folder is searched: a search in the folders above a mistyped one would find
  // another cell.
  if (globals.directory.empty()) return find_cell(fs::current_path());
  fs::path file = fs::path(globals.directory) / "cell.toml";
  if (fs::exists(file)) return file;
  throw Failure(Exit::kInput,
                {.code = "E-CELL-NONE",
                 .message = fmt::format("-C: there is no cell.toml in {}", globals.directory),
                 .help = "make one: plumb new DIR --dh F.csv --convention standard"});
}

void keep_files(const Cell& cell, Makes makes, Outcome& outcome) {
  auto& kept = outcome.kept;
  for (const char* name : {"cell.toml", "twin.toml", "runs"}) kept.push_back(cell.directory / name);
  if (makes != Makes::kModel) kept.push_back(cell.directory / "robot.plumb");
  if (makes == Makes::kMeasurements) return;
  for (const auto& file : measurement_files(cell.measurement)) kept.push_back(file);
}

void keep_cells_around(const Globals& globals, const fs::path& output, Outcome& outcome) {
  const auto keep_cell = [&](const auto& find) {
    fs::path file;
    try {
      file = find();
      keep_files(read_cell(file), Makes::kNone, outcome);
    } catch (const Failure&) {  // none, or one that cannot be read
      if (!file.empty()) outcome.kept.push_back(file);
    }
  };
  keep_cell([&] { return cell_file(globals); });
  std::error_code ignored;
  if (!output.empty())
    keep_cell([&] {
      return find_cell(fs::weakly_canonical(fs::absolute(output), ignored).parent_path());
    });
}

Cell open_cell(const Globals& globals, Outcome& outcome, Makes makes) {
  Cell cell = read_cell(cell_file(globals));
  keep_files(cell, makes, outcome);
  outcome.inputs.push_back({cell.file.string(), sha256(cell.text)});
  if (!cell.fit.prior_from.empty()) {
    const fs::path taught = cell.fit.earlier ? cell.fit.earlier->run / "run.json"
                                             : cell.directory / cell.fit.prior_from;
    outcome.inputs.push_back({taught.string(), sha256(read_file(taught))});
  }
  outcome.remark(cell.remarks);
  return cell;
}

MeasurementFiles open_measurements(Cell& cell, Outcome& outcome) {
  MeasurementFiles measured = read_cell_measurements(cell);
  note_tables(measured, outcome);
  return measured;
}

MeasurementFiles open_rows(const fs::path& file, const format::Chain& chain, Outcome& outcome) {
  MeasurementFiles rows = read_measurements({file}, chain, Needs::kJoints);
  note_tables(rows, outcome);
  return rows;
}

Fit fit_with_progress(const Cell& cell, const MeasurementFiles& measured, Outcome& outcome) {
  Progress progress(fmt::format("calibrating on {} poses", measured.size()));
  Fit fit = fit_cell(cell, measured, [&](const std::string& step) { progress.at(step); });
  outcome.remark(fit.remarks);
  return fit;
}

Run keep(const Cell& cell, const MeasurementFiles& measured, Fit fit) {
  lock_cell(cell.directory);
  const Writing writing;
  return save_run(cell, measured, std::move(fit));
}

void keep_floor(const Cell& cell, const Run& run, const NoiseFloor& floor) {
  lock_cell(cell.directory);
  const Writing writing;
  save_floor(run, floor);
}

Run current_or_new_run(const Cell& cell, const MeasurementFiles& measured, Keep keep_it,
                       Outcome& outcome) {
  if (auto run = current_run(cell, measured)) return std::move(*run);
  if (keep_it == Keep::kRun) {
    lock_cell(cell.directory);
    // Another plumb process may have made the run while this one waited for the lock.
    if (auto run = current_run(cell, measured)) return std::move(*run);
  }
  Fit fit = fit_with_progress(cell, measured, outcome);
  if (keep_it == Keep::kNothing) return draft_run(cell, measured, std::move(fit));
  Run run = keep(cell, measured, std::move(fit));
  outcome.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-RUN-NEW",
       .message =
           fmt::format("there was no run of the present cell and data: made run {}", run.number),
       .help = "plumb runs"});
  return run;
}

void stand_on_base_of(const Run& run, const Cell& cell, MeasurementFiles& measured) {
  if (run.fit.base == Base::kController) stand_on_controller(cell, measured);
}

void check_known_to_runtime(const Run& run, const MeasurementFiles& measured) {
  const double most = departure_of(measured).max;
  if (most <= kAsGoodAsTheArm_m) return;
  throw Failure(
      Exit::kInput,
      {.code = "E-RUN-BASE",
       .message =
           fmt::format("run {} stands on the controller's own positions, up to {} mm off the "
                       "arm of the cell, which is all that plumb-rt knows",
                       run.number, show::mm(most)),
       .help =
           "give [robot] joints the controller's own values, or calibrate that arm: plumb fit"});
}

show::ListedRun::State state_of(const Run& run, const Cell& cell,
                                const MeasurementFiles& measured) {
  const bool current = is_of_cell(run, cell) && is_of_data(run, measured);
  return current ? show::ListedRun::State::kCurrent : show::ListedRun::State::kOther;
}

void check_same_data(const Run& run, const MeasurementFiles& measured) {
  if (is_of_data(run, measured)) return;
  throw Failure(Exit::kInput,
                {.code = "E-RUN-DATA",
                 .message = fmt::format("run {} was made from other measurements than the present "
                                        "ones",
                                        run.number),
                 .help = "fit again: plumb fit"});
}

}  // namespace plumb::offline::cli
