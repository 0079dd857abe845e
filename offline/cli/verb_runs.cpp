// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "cli/cell_data.hpp"
#include "cli/verbs.hpp"
#include "show/runs_view.hpp"

namespace plumb::offline::cli {
namespace {

/// The history can be read without the measurements; then no run is the current one.
std::optional<Measurements> present_measurements(const Cell& cell, Outcome& outcome) {
  try {
    return open_measurements(cell, outcome);
  } catch (const Failure&) {
    outcome.remarks.push_back({.severity = Severity::kWarning,
                               .code = "W-RUN-NODATA",
                               .message =
                                   "the cell's measurements cannot be read: no run is marked "
                                   "as the current one",
                               .help = "plumb fit says why"});
    return std::nullopt;
  }
}

void runs(const Globals& globals, Outcome& outcome) {
  const Cell cell = open_cell(globals, outcome);
  const auto measured = present_measurements(cell, outcome);
  std::vector<show::ListedRun> list;
  for (int number : list_runs(cell)) {
    try {
      Run run = load_run(cell, number);
      const auto state = measured ? state_of(run, cell, *measured) : show::ListedRun::State::kOther;
      list.push_back({std::move(run), state});
    } catch (const Failure& damaged) {
      for (Problem problem : damaged.problems()) {
        problem.severity = Severity::kWarning;
        outcome.remarks.push_back(std::move(problem));
      }
    }
  }
  outcome.result = show::runs_json(list);
  outcome.text = show::runs_text(list);
}

}  // namespace

void add_runs(Program& program) {
  program.verb({.name = "runs",
                .summary = "History: every run with its held-out error",
                .examples = "  plumb runs\n  plumb -C mycell runs --json"},
               runs);
}

}  // namespace plumb::offline::cli
