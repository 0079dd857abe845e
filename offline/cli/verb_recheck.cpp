// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <tuple>

#include "arm/effect_binding.hpp"
#include "arm/known_inputs.hpp"
#include "cell/artefacts.hpp"
#include "cell/lost_points.hpp"
#include "cell/measurement_reader.hpp"
#include "cell/reading_digest.hpp"
#include "cell/setups.hpp"
#include "cli/cell_data.hpp"
#include "cli/cell_lock.hpp"
#include "cli/next_line.hpp"
#include "cli/progress.hpp"
#include "cli/run_number.hpp"
#include "cli/verbs.hpp"
#include "fit/cell_data.hpp"
#include "program/file.hpp"
#include "program/interrupt.hpp"
#include "recheck/recheck.hpp"
#include "runs/run_store.hpp"
#include "show/recheck_view.hpp"

namespace plumb::offline::cli {
namespace {

using recheck::Recheck;

struct RecheckArguments {
  std::string data, run;
  bool new_frame = false, new_target = false, dry_run = false;
};

/// New readings, and which rows of their file they are.
struct NewReadings {
  MeasurementFiles rows;
  std::vector<int> row;
  int in_file = 0;  // that are not marked 'ignore'
};

/// Whether they are readings of the calibration: its file, or rows of it in a file of another form.
bool of_calibration(const MeasurementFiles& rows, const MeasurementFiles& own) {
  for (const auto& mine : own.tables)
    if (mine.sha256 == rows.tables.front().sha256) return true;
  return count_known(rows, reading_digests(own)) == rows.size();
}

/// Refuses (E-RECHECK-POINT) fixed points that the tool touches, on either side: whether an arm is
/// still the same is judged by positions in one frame.
void refuse_touches(const Cell& cell, const MeasurementFiles& rows) {
  const bool of_rows = reads_artefact(rows.tables.front());
  if (!of_rows && !has_artefacts(cell.measurement)) return;
  throw Failure(Exit::kInput,
                {.code = "E-RECHECK-POINT",
                 .message = of_rows ? "rows that touch fixed points do not tell where the arm is: "
                                      "they are fitted, not compared"
                                    : "this arm was calibrated from points that its tool touched: "
                                      "nothing says where a tracker stands",
                 .help = "fit the new rows beside the old ones: add the file to files in "
                         "[measurement], and plumb fit"});
}

/// Refuses (E-RECHECK-OWN) the readings of the calibration itself.
NewReadings new_readings(const std::string& file, const Cell& cell, const MeasurementFiles& own,
                         Outcome& outcome) {
  MeasurementFiles all = read_measurements({file}, cell.nominal, Needs::kJointsAndPosition);
  refuse_touches(cell, all);
  ignore_lost_points(cell, all);
  const Table& table = all.tables.front();
  outcome.inputs.push_back({table.file, table.sha256});
  outcome.remark(table.remarks);
  if (of_calibration(all, own))
    throw Failure(Exit::kInput,
                  {.code = "E-RECHECK-OWN",
                   .message = fmt::format("{} holds the readings of the calibration itself",
                                          display_name(file)),
                   .help = "measure again: plumb plan --recheck -o plan.csv"});
  std::vector<int> used;
  for (int i = 0; i < all.size(); ++i)
    if (all.set[static_cast<std::size_t>(i)] != SetMark::kIgnore) used.push_back(i);
  if (used.empty())
    throw Failure(Exit::kInput, {.code = "E-RECHECK-NONE",
                                 .message = fmt::format("every reading of {} is marked 'ignore'",
                                                        display_name(file)),
                                 .help = "leave column set empty for those that count"});
  NewReadings out;
  out.in_file = static_cast<int>(used.size());
  for (const int i : recheck::judged_rows(out.in_file))
    out.row.push_back(used[static_cast<std::size_t>(i)]);
  out.rows = pick(all, out.row);
  return out;
}

/// The readings as measurements of the run that a recheck keeps: each held out once.
Fit fit_of(const Run& parent, const Recheck& found) {
  Fit out;
  out.calibration = found.calibration;
  out.tree = parent.fit.tree;
  out.base = parent.fit.base;
  out.predicted_M = found.predicted_M;
  out.split.folds = found.readings;
  for (int i = 0; i < found.readings; ++i) out.split.fold.push_back(i);
  out.split.held.assign(static_cast<std::size_t>(found.readings), false);
  out.split.used.assign(static_cast<std::size_t>(found.readings), true);
  out.held = out.held_without_outliers = out.geometry_held = found.after;
  out.fit = found.fitted;
  out.floor = parent.fit.floor;
  out.unavoidable_ratio = parent.fit.unavoidable_ratio;
  out.still = parent.fit.still;
  return out;
}

void note_few(const NewReadings& readings, const Recheck& found, Outcome& outcome) {
  if (readings.in_file > found.readings)
    outcome.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-RECHECK-SOME",
         .message = fmt::format("{} of {} readings are judged, evenly spread: a recheck is for few",
                                found.readings, readings.in_file),
         .help = "to calibrate with all of them: name the file in cell.toml, then plumb fit"});
  if (found.odd_readings.empty()) return;
  std::vector<std::string> names;
  for (const int row : found.odd_readings)
    names.push_back(readings.rows.pose[static_cast<std::size_t>(row)]);
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-RECHECK-ODD",
       .message =
           fmt::format("{} contradict{} all other readings and {} not used", fmt::join(names, ", "),
                       names.size() == 1 ? "s" : "", names.size() == 1 ? "was" : "were"),
       .help = "measure there again"});
}

/// Readings where the run was never fitted: what it misses there is no change.
void note_outside(const Run& parent, const MeasurementFiles& rows, Outcome& outcome) {
  const format::Model& model = parent.fit.calibration.state.arm;
  const auto sensors = temperature_names(model);
  KnownInputs inputs(model);
  for (int i = 0; i < rows.size(); ++i)
    std::ignore = inputs.mark({rows.q.row(i).data(), static_cast<std::size_t>(rows.q.cols())},
                              context_at(rows.context, i, sensors), true, Status::kOk);
  outcome.remark(inputs.remarks());
}

std::string next_step(const Recheck& found) {
  switch (found.verdict) {
    case Recheck::Verdict::kTrue:
      return "runs   # its history";
    case Recheck::Verdict::kUndecidable:
      return "plan --recheck -o plan.csv --force   # poses that can tell";
    case Recheck::Verdict::kChanged:
      break;
  }
  return found.something_else || found.turns.turned()
             ? "plan --n 30   # measure anew, then fit"
             : "compile --force   # the model with what has changed";
}

void recheck_cell(const RecheckArguments& options, const Globals& globals, Outcome& outcome) {
  Cell cell = open_cell(globals, outcome);
  const MeasurementFiles own = open_measurements(cell, outcome);
  const NewReadings readings = new_readings(options.data, cell, own, outcome);
  const MeasurementFiles& rows = readings.rows;
  const Run parent =
      options.run.empty()
          ? latest_recheck(
                cell, current_or_new_run(cell, own, options.dry_run ? Keep::kNothing : Keep::kRun,
                                         outcome))
          : load_run(cell, run_number(options.run));
  const Run calibrated = calibrated_run(cell, parent);
  check_same_data(calibrated, own);
  if (calibrated.fit.base == Base::kController)
    throw Failure(Exit::kInput,
                  {.code = "E-RECHECK-RUN",
                   .message = fmt::format("run {} stands on the controller's own positions, which "
                                          "recheck does not judge",
                                          calibrated.number),
                   .help = "calibrate the arm of the cell: plumb fit"});
  Recheck found;
  {
    const Progress progress(fmt::format("looking for what changed, {} readings", rows.size()));
    found =
        recheck::recheck_run(cell, calibrated, parent, own, rows,
                             {.new_frame = options.new_frame, .new_target = options.new_target});
  }
  note_few(readings, found, outcome);
  for (int& row : found.odd_readings) row = readings.row[static_cast<std::size_t>(row)];
  note_outside(parent, rows, outcome);
  outcome.result = show::recheck_json(cell, found, parent);
  put(show::recheck_blocks(cell, found, parent), outcome);
  const bool decided =
      found.verdict != Recheck::Verdict::kUndecidable || (found.keeps && !found.found.empty());
  if (options.dry_run || !decided) {
    const char* const why =
        options.dry_run ? "--dry-run keeps nothing" : "nothing is known that a run could keep";
    show::put_null(outcome.result, "run", why);
    outcome.text += fmt::format("\nno run was kept: {}\n", why);
  } else {
    lock_cell(cell.directory);
    const Writing writing;
    const Run run = save_recheck(cell, rows, fit_of(parent, found),
                                 {.parent = parent.number,
                                  .verdict = name_of(found.verdict),
                                  .words = show::recheck_sentence(cell, found, parent),
                                  .before = found.before,
                                  .expected_m = found.expected_m,
                                  .limit_m = found.control_m});
    outcome.result["run"] = run.number;
    outcome.text +=
        fmt::format("\nkept as run {}, a recheck of run {}\n", run.number, parent.number);
  }
  say_next(globals, next_step(found), outcome);
}

}  // namespace

void add_recheck(Program& program) {
  const auto options = std::make_shared<RecheckArguments>();
  VerbOptions verb = program.verb(
      {.name = "recheck",
       .summary = "Few poses later: is the calibration still true, or what has changed?",
       .examples =
           "  plumb recheck --data today.csv               # of the poses of plumb plan --recheck\n"
           "  plumb recheck --data today.csv --new-frame   # the tracker stands elsewhere"},
      [options](const Globals& g, Outcome& o) { recheck_cell(*options, g, o); });
  verb.add_option("--data", options->data, "Readings of 8 to 30 poses, as in measurements.csv")
      .type_name("FILE")
      .required();
  verb.add_option("--run", options->run, "Run to recheck; else the latest, or its latest recheck")
      .type_name("N");
  verb.add_flag("--new-frame", options->new_frame,
                "The tracker stands elsewhere on purpose: fit its frame anew, it is no change");
  verb.add_flag("--new-target", options->new_target,
                "The reflector sits elsewhere on purpose: fit its place anew, it is no change");
  verb.add_flag("--dry-run", options->dry_run, "Judge and show, but keep no run");
}

}  // namespace plumb::offline::cli
