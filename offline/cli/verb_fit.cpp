// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "answers/answers.hpp"
#include "cell/earlier_arm.hpp"
#include "cli/cell_data.hpp"
#include "cli/next_line.hpp"
#include "cli/run_number.hpp"
#include "cli/verbs.hpp"
#include "effects/registry.hpp"
#include "fit/controller_base.hpp"
#include "fit/verdict.hpp"
#include "noise/main_jump.hpp"
#include "noise/moving_part.hpp"
#include "runs/run_store.hpp"
#include "show/fit_view.hpp"
#include "show/units.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline::cli {
namespace {

struct FitArguments {
  bool dry_run = false;
  std::optional<double> max_rms_mm;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> held_out;
  std::string base = name_of(Base::kArm);
  std::optional<std::string> from, data;
};

/// The folder that --from means: a run of this cell by its number, or any folder.
std::filesystem::path folder_of(const std::string& from, const Cell& cell) {
  const bool number = from.find_first_not_of("0123456789") == std::string::npos;
  if (number) return load_run(cell, run_number(from)).directory;
  return std::filesystem::absolute(from).lexically_normal();
}

/// --data: these readings instead of the cell's.
void read_instead(const std::string& file, Cell& cell) {
  if (!cell.measurement.setups.empty())
    throw Failure(Exit::kUsage,
                  {.code = "E-USAGE",
                   .message = "--data: the cell has set-ups; of which one are these readings?",
                   .help = "give them a cell of their own, with [fit] prior_from naming the run"});
  if (!std::filesystem::exists(file))
    throw Failure(Exit::kInput,
                  {.code = "E-READ",
                   .message = fmt::format("--data: cannot read {}: no such file", file),
                   .help = "see what is there: ls -l"});
  cell.measurement.files = {std::filesystem::absolute(file).lexically_normal()};
  cell.measurement.named_at.clear();
}

/// What happened while the cell's own readings were taken (a step, a drift) did not happen to
/// others.
void leave_measurement_effects(Cell& cell, Outcome& outcome) {
  std::vector<std::string> left;
  std::erase_if(cell.effects, [&](const EffectEntry& effect) {
    const bool leaves = is_of_measurement(effect.name);
    if (leaves) left.push_back(effect.name);
    return leaves;
  });
  if (left.empty()) return;
  outcome.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-FIT-LEFT",
       .message = fmt::format("--data is another measurement, so what belongs to that of cell.toml "
                              "is left out: {}",
                              fmt::join(left, ", ")),
       .help = "once cell.toml names these readings: plumb drop " + left.front()});
}

/// --from and --data: an earlier arm instead of what the cell takes over, and other readings.
void take_over(const FitArguments& options, Cell& cell, Outcome& outcome) {
  if (!options.from) {
    if (!options.data) return;
    throw Failure(Exit::kUsage,
                  {.code = "E-USAGE",
                   .message = "--data: of which arm are these readings?",
                   .help = "name its run: plumb fit --from 1 --data " + *options.data +
                           "; or the file in [measurement] files of cell.toml"});
  }
  if (options.from->empty() || (options.data && options.data->empty()))
    throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                 .message = "--from and --data need a name, and got an empty one",
                                 .help = "plumb fit --from 1 --data later.csv"});
  std::erase_if(cell.fit.priors, [](const Prior& prior) { return prior.of_fleet; });
  cell.fit.sister_odds.clear();
  cell.fit.earlier = std::make_shared<EarlierArm>(earlier_arm(folder_of(*options.from, cell)));
  outcome.inputs.push_back(
      {(cell.fit.earlier->run / "run.json").string(), cell.fit.earlier->check_sum});
  if (!options.data) return;
  read_instead(*options.data, cell);
  leave_measurement_effects(cell, outcome);
}

/// What cell.toml must say so that every verb goes on with these readings and that prior.
std::string to_go_on(const FitArguments& options, const Cell& cell) {
  const auto shown = [&](const std::filesystem::path& path) {
    return std::filesystem::relative(path, cell.directory).generic_string();
  };
  std::string out = fmt::format(
      "\nThe other verbs know nothing of this until cell.toml says: [fit] prior_from = "
      "\"{}\"",
      shown(cell.fit.earlier->run));
  if (options.data)
    out +=
        fmt::format(", and [measurement] files = [\"{}\"]", shown(cell.measurement.files.front()));
  return out + ".\n";
}

void override_split(const FitArguments& options, Cell& cell) {
  if (options.seed) cell.measurement.seed = *options.seed;
  if (!options.held_out) return;
  const auto rule = parse_held_out(*options.held_out, std::filesystem::current_path());
  if (!rule)
    throw Failure(Exit::kUsage,
                  {.code = "E-USAGE",
                   .message = fmt::format("--held-out: '{}' is not a rule", *options.held_out),
                   .help = "auto, 20%, kfold:5, column:set or file:verify.csv"});
  cell.measurement.held_out = *rule;
}

/// The gate of --max-rms; true if it is passed.
bool passes(const FitArguments& options, const Fit& fit, Outcome& outcome) {
  if (!options.max_rms_mm) return true;
  const double rms_m = usual_held(fit).rms;
  if (fit.held.n > 0 && show::to_mm(rms_m) <= *options.max_rms_mm) return true;
  outcome.exit = Exit::kGateFailed;
  outcome.errors.push_back(
      {.code = "E-GATE-RMS",
       .message = fit.held.n == 0
                      ? "--max-rms: no pose was held out"
                      : fmt::format("held-out RMS {} mm{} exceeds --max-rms {} mm; no run was kept",
                                    show::mm(rms_m), without_words(fit), *options.max_rms_mm),
       .help = "see where it fails: plumb compare"});
  return false;
}

void keep_run(const FitArguments& options, const Cell& cell, const MeasurementFiles& measured,
              Fit fit, const std::optional<NoiseFloor>& diagnosed, Outcome& outcome) {
  if (!passes(options, fit, outcome)) {
    show::put_null(outcome.result, "run", "the gate failed");
  } else if (options.dry_run) {
    show::put_null(outcome.result, "run", "--dry-run keeps nothing");
    outcome.text += "\ndry run: no run was kept\n";
  } else {
    const Run run = keep(cell, measured, std::move(fit));
    if (diagnosed) keep_floor(cell, run, *diagnosed);
    outcome.result["run"] = run.number;
    outcome.result["run_directory"] = run.directory.string();
    outcome.text += fmt::format("\nkept as run {} in {}\n", run.number, run.directory.string());
  }
}

/// One sentence if a jump explains the error that the fit leaves, held-out rows included; compare
/// reports the details.
std::string jump_words(const Cell& cell, const MeasurementFiles& measured, const Fit& fit) {
  std::vector<int> used;
  for (int i = 0; i < measured.size(); ++i)
    if (fit.split.used[i]) used.push_back(i);
  const auto rows = without_outliers(
      without_outliers(thinned(measured, used, kRowsSearchedForJump), fit.calibration.outliers),
      fit.held_outliers);
  const auto step = main_jump(fit.calibration.state, measured, rows);
  if (!step) return "";
  return fmt::format(
      "\nIt looks as if {} moved between rows {} and {}, by some {} mm: see plumb compare.\n",
      in_words(cell, {step->source, step->joint}), step->before + 1, step->after + 1,
      size_in_mm(*step));
}

/// What a diagnosis of the same cell and data found: so fit and compare agree with it.
std::optional<NoiseFloor> floor_of_last_diagnosis(const Cell& cell,
                                                  const MeasurementFiles& measured,
                                                  const Fit& fitted) {
  try {
    const auto last = current_run(cell, measured);
    if (last && last->fit.base == fitted.base) return diagnosed_floor(*last);
  } catch (const Failure&) {
    // A damaged run is no reason not to fit: fitting again is its remedy.
  }
  return std::nullopt;
}

/// An earlier arm stands on the nominal numbers of the cell.
void refuse_earlier(const Cell& cell) {
  if (!cell.fit.earlier) return;
  throw Failure(
      Exit::kUsage,
      {.code = "E-USAGE",
       .message = "--base controller: an earlier run of the arm says nothing of the "
                  "controller's own positions",
       .help = "plumb fit --from RUN, or plumb fit --base controller without prior_from"});
}

void fit(const FitArguments& options, const Globals& globals, Outcome& outcome) {
  Cell cell = open_cell(globals, outcome);
  override_split(options, cell);
  take_over(options, cell, outcome);
  MeasurementFiles measured = open_measurements(cell, outcome);
  if (options.base == name_of(Base::kController)) {
    refuse_earlier(cell);
    stand_on_controller(cell, measured);
  }
  Fit fitted = fit_with_progress(cell, measured, outcome);
  const auto floor = floor_of_last_diagnosis(cell, measured, fitted);
  if (floor) fitted.floor.inferred_m = floor->inferred_m;
  const Answers answers = answers_of(cell, measured, fitted, nullptr);
  outcome.result = show::fit_json(cell, measured, fitted, answers);
  put(show::fit_blocks(cell, measured, fitted, answers), outcome);
  outcome.text += jump_words(cell, measured, fitted);
  const auto& like = fitted.calibration.likeness;
  const bool alike = options.from && like && like->kind != Likeness::Kind::kUnlike;
  keep_run(options, cell, measured, std::move(fitted), floor, outcome);
  if (alike && outcome.result["run"].is_number()) outcome.text += to_go_on(options, cell);
  if (!options.from) say_next(globals, answers.next, outcome);
}

}  // namespace

void add_fit(Program& program) {
  const auto options = std::make_shared<FitArguments>();
  VerbOptions verb = program.verb(
      {.name = "fit",
       .summary = "Calibrate the arm; keep an immutable run under runs/",
       .examples = "  plumb fit\n  plumb -C mycell fit --held-out kfold:5 --max-rms 0.1 --json\n"
                   "  plumb fit --from 1 --data later.csv   # the arm of run 1, measured again\n"
                   "  plumb -C arm2 fit --from arm1         # a sister of the arm of cell arm1"},
      [options](const Globals& g, Outcome& o) { fit(*options, g, o); });
  verb.add_flag("--dry-run", options->dry_run, "Fit and show, but keep no run");
  verb.add_option("--max-rms", options->max_rms_mm,
                  "Gate: exit 1 and keep nothing if the held-out RMS, without single readings that "
                  "stand out, exceeds this [mm]")
      .type_name("MM")
      .check(greater_than_zero());
  verb.add_option("--seed", options->seed, "Seed of the split, instead of the cell's")
      .type_name("N")
      .check(seed_number());
  verb.add_option("--held-out", options->held_out,
                  "Which poses are held out: auto, 20%, kfold:5, column:set, file:F.csv")
      .type_name("RULE");
  verb.add_option(
          "--from", options->from,
          "Take over what an earlier run knows of the arm, or of a sister: number of a run, "
          "folder of a run, or folder of a cell, whose latest run is meant")
      .type_name("RUN");
  verb.add_option("--data", options->data, "With --from: these readings instead of the cell's")
      .type_name("FILE");
  verb.add_option("--base", options->base,
                  "What is calibrated: the arm of the cell, or the controller's own positions "
                  "(columns nx_mm, ny_mm, nz_mm)")
      .type_name("arm|controller")
      .check(one_of({name_of(Base::kArm), name_of(Base::kController)}, InHelp::kHidden));
}

}  // namespace plumb::offline::cli
