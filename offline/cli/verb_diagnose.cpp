// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/cell_writing.hpp"
#include "cli/progress.hpp"
#include "cli/verbs.hpp"
#include "diagnose/diagnosis.hpp"
#include "show/diagnose_view.hpp"

namespace plumb::offline::cli {
namespace {

struct Options {
  bool apply = false;
  bool dry_run = false;
};

/// Learnt leaves come after the physics, and only the user asks for them.
std::vector<EffectEntry> with_tree_of(const Cell& cell, std::vector<EffectEntry> effects) {
  for (const auto& effect : cell.effects)
    if (effect.name == "local_tree") effects.push_back(effect);
  return effects;
}

void keep(const Options& options, const Cell& cell, const Measurements& measured,
          const Diagnosis& found, Outcome& outcome) {
  if (found.added.empty()) {
    show::put_null(outcome.result, "run", "nothing was added");
    return;
  }
  const Cell edited = with_effects(cell, with_tree_of(cell, found.effects));
  replace_cell(edited, options.dry_run, outcome);
  if (options.dry_run) {
    show::put_null(outcome.result, "run", "--dry-run keeps nothing");
    return;
  }
  const Run run = current_or_new_run(edited, measured, Keep::kRun, outcome);
  outcome.result["run"] = run.number;
}

void diagnose_cell(const Options& options, const Globals& globals, Outcome& outcome) {
  const Cell cell = open_cell(globals, outcome);
  Measurements measured = open_measurements(cell, outcome);
  if (options.dry_run) {
    if (const auto run = current_run(cell, measured)) stand_on_base_of(*run, cell, measured);
  } else {
    stand_on_base_of(current_or_new_run(cell, measured, Keep::kRun, outcome), cell, measured);
  }
  const auto found = [&] {
    const Progress progress(fmt::format("diagnosing {} poses", measured.size()));
    return diagnose(cell, measured, {.apply = options.apply, .tell = {}});
  }();
  outcome.result = show::diagnose_json(cell, found);
  outcome.text = show::diagnose_text(cell, found);
  if (options.apply) keep(options, cell, measured, found, outcome);
}

}  // namespace

void add_diagnose(Program& program) {
  const auto options = std::make_shared<Options>();
  CLI::App& verb = program.verb(
      {.name = "diagnose",
       .summary = "Which physical effect is missing: ranked, with evidence",
       .examples = "  plumb diagnose                    # what is missing, and how sure is that?\n"
                   "  plumb diagnose --apply            # add what is supported, until nothing is"},
      [options](const Globals& g, Outcome& o) { diagnose_cell(*options, g, o); });
  verb.add_flag("--apply", options->apply,
                "Add the supported effects one by one to cell.toml, and refit");
  verb.add_flag("--dry-run", options->dry_run, "Show what --apply would do, but write nothing");
}

}  // namespace plumb::offline::cli
