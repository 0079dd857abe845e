// SPDX-License-Identifier: Apache-2.0
#include "cli/compiled.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/model_limits.hpp"
#include "cli/progress.hpp"
#include "compile/compiler.hpp"
#include "fit/fit_cell.hpp"
#include "fit/verdict.hpp"
#include "program/file.hpp"
#include "program/shell_word.hpp"
#include "runs/run_store.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr const char* kSizeUnknown = "nothing that was read tells the size of the arm";

/// Why the held-out figure of a model does not keep the tolerance; empty if it does.
std::string beyond_tolerance(const Compiled& made, double tolerance_m) {
  const ErrorStats& held = made.held;
  if (held.n == 0 || keeps(held, tolerance_m)) return "";
  if (held.p95 > tolerance_m)
    return fmt::format("the held-out error at 95 %{}, {} mm, exceeds the tolerance of {} mm",
                       made.without, show::mm(held.p95), show::mm(tolerance_m));
  return fmt::format("a held-out pose misses by {} mm, far beyond the tolerance of {} mm",
                     show::mm(held.max), show::mm(tolerance_m));
}

void warn_of_tolerance(const Compiled& made, double tolerance_m, Outcome& outcome) {
  const std::string why = beyond_tolerance(made, tolerance_m);
  if (why.empty()) return;
  outcome.remarks.push_back({.severity = Severity::kWarning,
                             .code = "W-COMPILE-TOLERANCE",
                             .message = why,
                             .help = "see where it fails: plumb compare"});
}

void warn_of_serial(const Cell& cell, Outcome& outcome) {
  if (cell.serial.find_first_not_of(" \t") != std::string::npos) return;
  outcome.remarks.push_back({.severity = Severity::kWarning,
                             .code = "W-COMPILE-SERIAL",
                             .message =
                                 "the cell names no serial number, so the model is not bound "
                                 "to one robot",
                             .place = Place{.file = display_name(cell.file)},
                             .help = "[cell] serial = \"that of the arm\""});
}

/// What was fitted and is not in the model: it belongs to the measurement.
void note_what_is_left(const Run& run, const format::Model& model, Outcome& outcome) {
  std::vector<std::string> names;
  for (const auto& effect : run.fit.calibration.state.arm.effects) {
    const auto same = [&](const format::Effect& other) { return other.name == effect.name; };
    if (std::none_of(model.effects.begin(), model.effects.end(), same))
      names.push_back(effect.name);
  }
  if (names.empty()) return;
  outcome.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-COMPILE-LEFT",
       .message = fmt::format("not in the model, for it belongs to the measurement: {}",
                              fmt::join(names, ", ")),
       .help = "plumb explain " + names.front()});
}

/// The run as it is known since its last recheck.
Run rechecked(const Cell& cell, Run run, Outcome& outcome) {
  if (run.number == 0) return run;
  const int calibrated = run.number;
  run = latest_recheck(cell, std::move(run));
  if (run.recheck)
    outcome.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-COMPILE-RECHECK",
         .message = fmt::format("this is run {}, a recheck of run {}: {}", run.number, calibrated,
                                run.recheck->words),
         .help = "plumb runs; the calibration alone, on all its poses: --refit-all"});
  return run;
}

void warn_of_left_out(const Cell& cell, const Run& run, Outcome& outcome) {
  const auto recheck = left_out_recheck(cell, run);
  if (!recheck) return;
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-COMPILE-RECHECK",
       .message =
           fmt::format("what recheck {} found is not in this model, which is that of the arm "
                       "before: {}",
                       recheck->number, recheck->recheck->words),
       .help = fmt::format("recheck again with its readings, then compile: plumb recheck --data {}",
                           shell_word(recheck->inputs.empty() ? std::string("FILE")
                                                              : recheck->inputs.front().name))});
}

}  // namespace

void CompileOptions::add_to(VerbOptions& verb) {
  verb.add_flag("--refit-all", refit_all,
                "Use every pose, as folds do anyway; the model then carries no held-out figure");
  verb.add_flag("--gate", gate,
                "Exit 1 and write nothing if the audit warns or 95 % of the held-out poses are not "
                "within tolerance");
}

void Compiled::put_run(Json& result) const {
  if (run > 0)
    result["run"] = run;
  else
    put_null(result, "run", "--dry-run keeps nothing");
  result["refit_all"] = refit_all;
}

Compiled compiled(Cell& cell, const CompileOptions& options, const WriteOptions& write,
                  Outcome& outcome) {
  MeasurementFiles measured = open_measurements(cell, outcome);
  Run run =
      current_or_new_run(cell, measured, write.dry_run ? Keep::kNothing : Keep::kRun, outcome);
  stand_on_base_of(run, cell, measured);
  check_known_to_runtime(run, measured);
  if (!options.refit_all) run = rechecked(cell, std::move(run), outcome);
  warn_of_left_out(cell, run, outcome);
  const int number = run.number;
  const std::string kept = number > 0 ? fmt::format("{:04}", number) : "not kept";
  if (options.refit_all) {
    const Progress progress("calibrating on every pose");
    run = draft_run(cell, measured, fit_all(cell, measured));
  }
  format::Model model = compile(cell, run);
  check_effect_sizes(model.effects);
  note_what_is_left(run, model, outcome);
  warn_of_serial(cell, outcome);
  model.provenance.run = options.refit_all ? kept + ", refitted on all poses" : kept;
  Compiled out{.model = std::move(model),
               .run = number,
               .refit_all = options.refit_all,
               .folds = run.recheck ? 0 : run.fit.split.folds,
               .held = usual_held(run.fit),
               .without = without_words(run.fit),
               .size_unknown = run.fit.size_unknown};
  if (!options.gate) warn_of_tolerance(out, cell.tolerance_m, outcome);
  return out;
}

void check_gate(const Audit& audit, const Compiled& made, double tolerance_m, Outcome& outcome) {
  const auto fail = [&](const std::string& why) {
    outcome.exit = Exit::kGateFailed;
    outcome.errors.push_back({.code = "E-GATE",
                              .message = "--gate: " + why + "; nothing was written",
                              .help = "to write it nevertheless, leave out --gate"});
  };
  for (const auto& remark : audit.remarks)
    if (remark.severity == Severity::kWarning) fail(remark.message);
  if (const std::string why = beyond_tolerance(made, tolerance_m); !why.empty()) fail(why);
  if (made.size_unknown) fail(kSizeUnknown);
}

std::string compiled_headline(const Compiled& made, double tolerance_m) {
  const format::Model& model = made.model;
  const ErrorStats& held = made.held;
  const std::string error =
      held.n == 0 ? "no held-out figure"
                  : fmt::format("held-out mean {} mm, 95 % {} mm{}", show::mm(held.mean),
                                show::mm(held.p95), made.without);
  const std::string beyond = beyond_tolerance(made, tolerance_m);
  const std::string whose =
      made.folds == 0 ? ""
                      : fmt::format(
                            "The model was fitted on all {} readings; the error above is that of "
                            "{} models, each on the poses that it was fitted without.\n\n",
                            model.provenance.poses_fit, made.folds);
  return fmt::format("Compiled {} for {} ({}): {}.{}\n\n{}", model.cell_name, model.robot_name,
                     model.serial.find_first_not_of(" \t") == std::string::npos
                         ? "no serial number"
                         : "serial " + model.serial,
                     error,
                     !beyond.empty()     ? " Not good enough: " + beyond + "."
                     : made.size_unknown ? fmt::format(" Good in shape only: {}.", kSizeUnknown)
                                         : "",
                     whose);
}

}  // namespace plumb::offline::cli
