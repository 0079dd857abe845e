// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "answers/after_diagnosis.hpp"
#include "answers/answers.hpp"
#include "answers/kept_diagnosis.hpp"
#include "cli/cell_writing.hpp"
#include "cli/next_line.hpp"
#include "cli/progress.hpp"
#include "cli/verbs.hpp"
#include "diagnose/diagnosis.hpp"
#include "effects/registry.hpp"
#include "fit/verdict.hpp"
#include "runs/run_store.hpp"
#include "show/diagnose_view.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

struct DiagnoseArguments {
  bool apply = false;
  bool all = false;
  bool dry_run = false;
};

/// The tree that the user has listed in the cell stays, behind the physical effects. The diagnosis
/// never adds one.
std::vector<EffectEntry> with_tree_of(const Cell& cell, std::vector<EffectEntry> effects) {
  for (const auto& effect : cell.effects)
    if (is_local_tree(effect.name)) effects.push_back(effect);
  return effects;
}

constexpr double kAnotherFloor = 1e-3;  // relative
constexpr double kRose = 1.05;          // times the error before: more is refused

/// Reports that the effects are not kept: fitted together from the start, they may converge to
/// another solution than when they were added one by one.
void refuse(const Fit& fitted, double before_m, Outcome& outcome) {
  show::put_null(outcome.result, "run", "fitted together, the effects raise the held-out error");
  outcome.text += fmt::format(
      "\nNot kept: fitted together from the start, these effects raise the error on unseen "
      "readings "
      "from {} to {} mm. cell.toml was not changed.\n",
      show::mm(before_m), show::mm(usual_held(fitted).mean));
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-DIAGNOSE-ROSE",
       .message = fmt::format("the effects were not added: fitted together they raise the error on "
                              "unseen readings from {} to {} mm",
                              show::mm(before_m), show::mm(usual_held(fitted).mean)),
       .help = "plumb explain W-DIAGNOSE-ROSE"});
}

/// Whether a diagnosis sees another scatter of the joints than the run knows.
bool differs(const NoiseFloor& found, const NoiseFloor& kept) {
  return std::abs(found.inferred_m - kept.inferred_m) > kAnotherFloor * kept.mean_m;
}

/// Writes findings and noise floor beside the run, where compare and report find them. A folder
/// that cannot be written is no error: compare and report then do without.
void keep_what_was_found(const Cell& cell, const Run& run, const Diagnosis& found) {
  if (found.added.empty()) {
    Diagnosis of_this_run = found;
    of_this_run.finding_after.reset();
    keep_diagnosis(run, of_this_run);
  }
  // If effects were added the floor belongs to the new model, and its run keeps it.
  if (!found.added.empty() || !differs(found.floor, run.fit.floor)) return;
  try {
    keep_floor(cell, run, found.floor);
  } catch (const Failure&) {
  }
}

void answer(const Answers& answers, Outcome& outcome) {
  outcome.result["finding"] = to_json(answers);
}

void answer_of_before(const Cell& cell, const MeasurementFiles& measured,
                      const std::optional<Run>& before, const Diagnosis& found, Outcome& outcome) {
  if (!before) return show::put_null(outcome.result, "finding", "--dry-run fits nothing");
  answer(answers_of(cell, measured, before->fit, &found), outcome);
}

/// False if the effects were refused.
bool keep_applied(const DiagnoseArguments& options, const Cell& cell,
                  const MeasurementFiles& measured, const Diagnosis& found, double before_m,
                  Outcome& outcome) {
  if (found.added.empty()) {
    show::put_null(outcome.result, "run", "nothing was added");
    return true;
  }
  const Cell edited = with_effects(cell, with_tree_of(cell, found.effects));
  if (options.dry_run) {
    replace_cell(cell, edited, options.dry_run, outcome);
    show::put_null(outcome.result, "run", "--dry-run keeps nothing");
    return true;
  }
  Fit fitted = fit_with_progress(edited, measured, outcome);
  if (fitted.held.n > 0 && usual_held(fitted).mean > kRose * before_m) {
    refuse(fitted, before_m, outcome);
    return false;
  }
  // The cell file last: if the run cannot be written, nothing has changed.
  fitted.floor.inferred_m = found.floor.inferred_m;
  const Run run = keep(edited, measured, std::move(fitted));
  keep_floor(edited, run, run.fit.floor);
  keep_diagnosis(run, found);
  answer(answers_of(edited, measured, run.fit, &found), outcome);
  replace_cell(cell, edited, options.dry_run, outcome);
  outcome.result["run"] = run.number;
  return true;
}

void diagnose_cell(const DiagnoseArguments& options, const Globals& globals, Outcome& outcome) {
  Cell cell = options.apply && !options.dry_run ? open_cell_to_change(globals, outcome)
                                                : open_cell(globals, outcome);
  MeasurementFiles measured = open_measurements(cell, outcome);
  double before_m = std::numeric_limits<double>::infinity();
  std::optional<Run> before = options.dry_run
                                  ? current_run(cell, measured)
                                  : current_or_new_run(cell, measured, Keep::kRun, outcome);
  if (before) {
    if (!options.dry_run && before->fit.held.n > 0) before_m = usual_held(before->fit).mean;
    stand_on_base_of(*before, cell, measured);
  }
  const auto found = [&] {
    Progress progress(fmt::format("diagnosing {} poses", measured.size()));
    return diagnose(cell, measured, {.apply = options.apply, .tell = [&](const std::string& step) {
                                       progress.at(step);
                                     }});
  }();
  outcome.remark(found.remarks);
  if (before && !options.dry_run) keep_what_was_found(cell, *before, found);
  outcome.result = show::diagnose_json(cell, found);
  outcome.verdicts = {{found.text, show::class_of(found.finding)}};
  put(show::diagnosis_blocks(cell, found,
                             options.all ? show::Candidates::kAll : show::Candidates::kFirst),
      outcome);
  const bool kept =
      !options.apply || keep_applied(options, cell, measured, found, before_m, outcome);
  // That of a new model is there already.
  if (!outcome.result.contains("finding")) answer_of_before(cell, measured, before, found, outcome);
  if (!kept) return say_next(globals, "compare   # where does the model fail?", outcome);
  say_next(globals, after_diagnosis(cell, found), outcome);
}

}  // namespace

void add_diagnose(Program& program) {
  const auto options = std::make_shared<DiagnoseArguments>();
  VerbOptions verb = program.verb(
      {.name = "diagnose",
       .summary = "Which physical effect is missing: ranked, with evidence",
       .examples = "  plumb diagnose                    # what is missing, and how sure is that?\n"
                   "  plumb diagnose --apply            # add what is supported, until nothing is"},
      [options](const Globals& g, Outcome& o) { diagnose_cell(*options, g, o); });
  verb.add_flag("--apply", options->apply,
                "Add the supported effects one by one to cell.toml, and refit");
  verb.add_flag("--all", options->all, "Show every candidate with all that is known of it");
  verb.add_flag("--dry-run", options->dry_run, "Show what --apply would do, but write nothing");
}

}  // namespace plumb::offline::cli
