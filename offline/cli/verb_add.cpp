// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "answers/answers.hpp"
#include "arm/effect_binding.hpp"
#include "cell/effect_arguments.hpp"
#include "cli/cell_writing.hpp"
#include "cli/effect_options.hpp"
#include "cli/model_limits.hpp"
#include "cli/next_line.hpp"
#include "cli/verbs.hpp"
#include "compile/compiler.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/effect_words.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "figures/law_figures.hpp"
#include "fit/cell_data.hpp"
#include "fit/verdict.hpp"
#include "program/file.hpp"
#include "runs/run_store.hpp"
#include "show/diagnose_view.hpp"
#include "show/error_table.hpp"
#include "show/heads.hpp"
#include "show/table.hpp"
#include "show/units.hpp"
#include "show/verdict_json.hpp"

namespace plumb::offline::cli {
namespace {

struct AddArguments {
  EffectOptions effect;
  bool dry_run = false;
};

std::string before_and_after(const MeasurementFiles& measured, const Fit& before,
                             const Fit& after) {
  namespace head = show::head;
  show::Table table{.head = {head::kHeldOutError, head::kMean, head::kInterval, head::kRms,
                             head::kP95, head::kMax}};
  const auto add = [&](const char* name, const Fit& fit) {
    const ErrorStats& e = fit.held;
    table.add({name, show::mm(e.mean), show::text_of(held_out_interval(measured, fit)),
               show::mm(e.rms), show::mm(e.p95), show::mm(e.max)});
  };
  add("before", before);
  add("after", after);
  return show::text_of(table);
}

std::string judged(const std::string& what, const Fit& before, const Fit& after) {
  const double then_m = usual_held(before).mean, now_m = usual_held(after).mean;
  const double change = then_m > 0.0 ? now_m / then_m - 1.0 : 0.0;
  const char* word = change < -0.01 ? "fell" : change > 0.01 ? "ROSE" : "hardly changed";
  return fmt::format("{}: the held-out error {}: {} -> {} mm ({:+.0f} %){}.", what, word,
                     show::mm(then_m), show::mm(now_m), 100.0 * change, without_words(after));
}

/// A sentence if a tree was asked for and has no leaves; else nothing.
std::string empty_tree_words(const Fit& fit) {
  if (!fit.tree || std::any_of(fit.tree->leaves.begin(), fit.tree->leaves.end(),
                               [](int leaves) { return leaves > 0; }))
    return "";
  return "The tree is empty: no leaf lowers the error on folds of the fit poses, so it corrects "
         "nothing.\n";
}

/// An effect of the command line is in no file yet: its problems are reported for the option from
/// which it comes.
void checked(const EffectOptions& options, const Cell& cell, const std::function<void()>& work) {
  try {
    work();
  } catch (const Failure& failure) {
    std::vector<Problem> problems = failure.problems();
    bool ours = false;
    for (auto& problem : problems) {
      if (problem.code == "E-FIT-CONVERGE") {
        problem.message += "; cell.toml was not changed";
        problem.help =
            "these poses may not show it beside the rest: plumb diagnose ranks what they show";
      }
      if (!problem.place || problem.place->line <= 0 ||
          problem.place->file != display_name(cell.file))
        continue;
      problem.place = options.place_at(*problem.place);
      ours = true;
    }
    throw Failure(ours ? Exit::kUsage : failure.exit_code(), std::move(problems));
  }
}

/// The formulas of a fit, each with its curve, narrow enough for a telephone.
std::string formula_figure(const Cell& cell, const MeasurementFiles& measured, const Fit& fit) {
  constexpr double kWidth_px = 440.0;
  const Run run = draft_run(cell, measured, Fit(fit));
  return figures::formulas_figure(figures::results_of(cell, measured, run), kWidth_px);
}

/// What is done, and how it is taken back.
struct Change {
  std::string what, undo;
  std::vector<EffectEntry> effects;
  bool adds = false;  // false: it removes effects
};

/// Refits with other effects, shows before and after, and only then touches the cell file.
void make(const Change& change, const AddArguments& options, const Globals& globals, Cell& cell,
          Outcome& outcome) {
  std::optional<Cell> read_back;
  checked(options.effect, cell, [&] { read_back = with_effects(cell, change.effects); });
  Cell& edited = *read_back;
  MeasurementFiles measured = open_measurements(cell, outcome);
  edited.measurement = cell.measurement;  // with the points that its rows touch
  checked(options.effect, cell, [&] {
    check_rows(edited, measured);
    if (change.adds) check_effect_sizes(bind_effects(edited, measured));
  });
  const Keep keep_it = options.dry_run ? Keep::kNothing : Keep::kRun;
  const Run before = current_or_new_run(cell, measured, keep_it, outcome);
  stand_on_base_of(before, cell, measured);
  Fit fitted;
  checked(options.effect, cell, [&] { fitted = fit_with_progress(edited, measured, outcome); });
  if (change.adds) check_parameter_count(compile(edited, draft_run(edited, measured, Fit(fitted))));
  // What a diagnosis found of the joints' scatter holds for any model of these readings.
  const auto floor = diagnosed_floor(before);
  if (floor) fitted.floor.inferred_m = floor->inferred_m;
  outcome.result["before"] = show::stats_json(before.fit.held);
  outcome.result["after"] = show::stats_json(fitted.held);
  outcome.result["run_before"] = before.number;
  const Answers answers = answers_of(edited, measured, fitted, nullptr);
  show::add_verdict(edited, fitted, answers, outcome.result);
  outcome.text = judged(change.what, before.fit, fitted) + "\n" + empty_tree_words(fitted) + "\n" +
                 before_and_after(measured, before.fit, fitted) + "\n" + answers.sentence + "\n";
  if (change.adds && is_formula(outcome.result["effect"].get<std::string>()) &&
      globals.output == Globals::Output::kJson)
    outcome.result["figure"] = formula_figure(edited, measured, fitted);
  if (options.dry_run) {
    replace_cell(cell, edited, options.dry_run, outcome);
    show::put_null(outcome.result, "run", "--dry-run keeps nothing");
    return say_next(globals, answers.next, outcome);
  }
  // The cell file last: if the run cannot be written, nothing has changed.
  const Run after = keep(edited, measured, std::move(fitted));
  if (floor) keep_floor(edited, after, after.fit.floor);
  replace_cell(cell, edited, options.dry_run, outcome);
  outcome.result["run"] = after.number;
  const bool rose = usual_held(after.fit).mean > usual_held(before.fit).mean;
  outcome.text += fmt::format("kept as run {}{}\n", after.number,
                              rose ? "" : "; to take it back: " + to_type(globals, change.undo));
  say_next(globals, rose ? change.undo + "   # takes it back" : answers.next, outcome);
}

/// "gear ripple of J2, 7.91 and 17.49 cycles a turn"
std::string together(const Cell& cell, const std::vector<EffectEntry>& entries) {
  std::vector<double> cycles;
  for (const auto& entry : entries)
    if (has_option(entry, OptionKey::kCyclesPerTurn))
      cycles.push_back(number_option(entry, OptionKey::kCyclesPerTurn, 0.0));
  if (cycles.size() == entries.size()) return in_words(cell, entries.front(), cycles);
  std::vector<std::string> out;
  for (const auto& entry : entries) out.push_back(in_words(cell, entry));
  return fmt::format("{}", fmt::join(out, " and "));
}

void say_which(const Cell& cell, const std::vector<EffectEntry>& entries, Outcome& outcome) {
  outcome.result["effect"] = entries.front().name;
  outcome.result["joints"] = show::joints_json(cell, entries.front());
}

void add(const AddArguments& options, const Globals& globals, Outcome& outcome) {
  Cell cell = options.dry_run ? open_cell(globals, outcome) : open_cell_to_change(globals, outcome);
  const auto entries = options.effect.to_add(cell);
  say_which(cell, entries, outcome);
  Change change{.what = "Added " + together(cell, entries),
                .undo = "drop " + dropping_arguments(cell, entries),
                .effects = cell.effects,
                .adds = true};
  for (const auto& entry : entries) {
    if (has_effect(cell.effects, entry))
      throw Failure(Exit::kInput, Problem{.code = "E-ADD-TWICE",
                                          .message = fmt::format("the model already has {}",
                                                                 in_words(cell, entry)),
                                          .place = Place{.file = cell.file.string()},
                                          .help = "see what is in it: plumb compare"});
    change.effects = with_effect(change.effects, entry);
  }
  make(change, options, globals, cell, outcome);
}

[[noreturn]] void nothing_to_drop(const Cell& cell, const EffectEntry& entry) {
  std::vector<EffectEntry> there;
  for (const auto& e : cell.effects)
    if (!is_geometry(e.name)) there.push_back(e);
  throw Failure(
      Exit::kInput,
      {.code = "E-DROP-NONE",
       .message = is_geometry(entry.name)
                      ? "geometry cannot be dropped: every model has it"
                      : fmt::format("the model has no {}", in_words(cell, entry)),
       .place = Place{.file = cell.file.string()},
       .help = there.empty() ? "it contains geometry alone"
                             : fmt::format("plumb drop {}", fmt::join(adding_arguments(cell, there),
                                                                      ", or: plumb drop "))});
}

void drop(const AddArguments& options, const Globals& globals, Outcome& outcome) {
  Cell cell = options.dry_run ? open_cell(globals, outcome) : open_cell_to_change(globals, outcome);
  const auto entries = options.effect.to_drop(cell);
  say_which(cell, entries, outcome);
  auto effects = cell.effects;
  for (const auto& entry : entries) {
    const auto less = without_effect(effects, entry);
    if (is_geometry(entry.name) || taken_out(effects, less).empty()) nothing_to_drop(cell, entry);
    effects = less;
  }
  std::vector<std::string> undo;
  for (const auto& words : adding_arguments(cell, taken_out(cell.effects, effects)))
    undo.push_back("add " + words);
  make({.what = "Dropped " + together(cell, entries),
        .undo = fmt::format("{}", fmt::join(undo, " && plumb ")),
        .effects = effects},
       options, globals, cell, outcome);
}

using Verb = void (*)(const AddArguments&, const Globals&, Outcome&);

void add_verb(Program& program, const VerbText& text, bool law_too, Verb run) {
  const auto options = std::make_shared<AddArguments>();
  VerbOptions verb =
      program.verb(text, [options, run](const Globals& g, Outcome& o) { run(*options, g, o); });
  options->effect.add_to(verb, law_too);
  verb.add_flag("--dry-run", options->dry_run, "Refit and show, but write nothing");
}

}  // namespace

void add_add(Program& program) {
  add_verb(program,
           {.name = "add",
            .summary = "Put an effect into the model, refit, and watch the held-out error",
            .examples = "  plumb add joint_compliance --joints J2,J3\n"
                        "  plumb add gear_ripple --joints J2 --set cycles_per_turn=8,20 --dry-run\n"
                        "  plumb add formula --formula \"dq2 = k*tau2\" "
                        "--parameter \"k [rad/(N m)] ~ 1e-6\""},
           true, add);
}

void add_drop(Program& program) {
  add_verb(program,
           {.name = "drop",
            .summary = "Take an effect out of the model, refit, and watch the held-out error",
            .examples = "  plumb drop joint_compliance\n"
                        "  plumb drop joint_compliance --joints J3 --dry-run"},
           false, drop);
}

}  // namespace plumb::offline::cli
