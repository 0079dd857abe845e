// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include <memory>

#include "answers/answers.hpp"
#include "cli/cell_data.hpp"
#include "cli/next_line.hpp"
#include "cli/run_number.hpp"
#include "cli/verbs.hpp"
#include "compare/comparison.hpp"
#include "runs/earlier_runs.hpp"
#include "runs/run_store.hpp"
#include "show/compare_view.hpp"
#include "show/runs_view.hpp"

namespace plumb::offline::cli {
namespace {

using Runs = std::vector<std::string>;

std::vector<show::ListedRun> wanted(const Runs& names, const Cell& cell,
                                    const MeasurementFiles& measured, Outcome& outcome) {
  std::vector<show::ListedRun> out;
  for (const auto& name : names) {
    Run run = load_run(cell, run_number(name));
    check_same_data(run, measured);
    const auto state = state_of(run, cell, measured);
    out.push_back({std::move(run), state});
  }
  if (out.empty())
    out.push_back({current_or_new_run(cell, measured, Keep::kRun, outcome),
                   show::ListedRun::State::kCurrent});
  return out;
}

/// Frees most of the memory that many readings take. The texts of rows are only quoted in messages
/// of a fit, and none is made here.
void forget_rows(MeasurementFiles& measured) {
  for (Table& table : measured.tables) {
    table.raw_rows = {};
    table.raw_rows.resize(table.lines.size());
    table.columns.clear();
  }
}

/// Blocks of memory from this size on go back to the system when they are freed [bytes]. By default
/// the limit grows up to 32 MB, and with a million rows the process would keep many such blocks.
constexpr int kGivenBack = 4 << 20;

void compare_runs(const Runs& names, const Globals& globals, Outcome& outcome) {
  ::mallopt(M_MMAP_THRESHOLD, kGivenBack);
  Cell cell = open_cell(globals, outcome);
  MeasurementFiles measured = open_measurements(cell, outcome);
  if (!names.empty() || seems_fitted(cell, measured)) forget_rows(measured);
  const auto runs = wanted(names, cell, measured, outcome);
  const Run& last = runs.back().run;
  stand_on_base_of(last, cell, measured);
  measured.tables = {};
  const auto comparison = compare::comparison(cell, measured, last.fit);
  const Answers answers = answers_of(cell, measured, last);
  outcome.result = show::compare_json(cell, measured, comparison, last, answers);
  show::Blocks blocks = show::compare_blocks(cell, measured, comparison, last, answers);
  if (runs.size() > 1) {
    outcome.result.update(show::runs_json(runs));
    std::string& verdict = std::get<show::Sentence>(blocks.front()).words;
    verdict = "Run " + std::to_string(last.number) + ": " + verdict;
    show::Blocks all = show::runs_blocks(runs);
    append(all, std::move(blocks));
    blocks = std::move(all);
  }
  put(blocks, outcome);
  say_next(globals, show::after_comparison(cell, comparison, last.fit, answers), outcome);
}

}  // namespace

void add_compare(Program& program) {
  const auto runs = std::make_shared<Runs>();
  VerbOptions verb = program.verb(
      {.name = "compare",
       .summary = "Model against measurements: error table, worst poses, where it fails",
       .examples = "  plumb compare                     # the run of the present cell and data\n"
                   "  plumb compare 1 2                 # side by side, then run 2 in full"},
      [runs](const Globals& g, Outcome& o) { compare_runs(*runs, g, o); });
  verb.add_option("RUN", *runs, "Runs to compare; the last one in full");
}

}  // namespace plumb::offline::cli
