// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <optional>

#include "cell/run_checksum.hpp"
#include "cli/cell_data.hpp"
#include "cli/next_line.hpp"
#include "cli/verbs.hpp"
#include "runs/run_store.hpp"
#include "show/runs_view.hpp"

namespace plumb::offline::cli {
namespace {

/// The history can be read without the measurements; then no run is the current one.
std::optional<MeasurementFiles> present_measurements(Cell& cell, Outcome& outcome) {
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

void note_no_sums(int number, Outcome& outcome) {
  outcome.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-RUN-NOSUM",
       .message = fmt::format("run {} has no check sums: an earlier version made it", number),
       .help = "plumb explain N-RUN-NOSUM"});
}

void runs(const Globals& globals, Outcome& outcome) {
  Cell cell = open_cell(globals, outcome);
  const auto measured = present_measurements(cell, outcome);
  std::vector<show::ListedRun> list;
  Json damaged_runs = Json::array();
  for (int number : list_runs(cell)) {
    try {
      Run run = load_run(cell, number);
      const auto state = measured ? state_of(run, cell, *measured) : show::ListedRun::State::kOther;
      if (!has_checksums(run.directory)) note_no_sums(number, outcome);
      list.push_back({std::move(run), state});
    } catch (const Failure& damaged) {
      damaged_runs.push_back(number);
      for (Problem problem : damaged.problems()) {
        problem.severity = Severity::kWarning;
        problem.code = "W-RUN-DAMAGED";
        outcome.remarks.push_back(std::move(problem));
      }
    }
  }
  outcome.result = show::runs_json(list);
  outcome.result["damaged"] = damaged_runs;
  outcome.text = list.empty() && !damaged_runs.empty() ? "No run can be read.\n"
                                                       : text_of(show::runs_blocks(list));
  for (const auto& number : damaged_runs)
    outcome.text += fmt::format("{:04}: damaged, not shown\n", number.get<int>());
  if (list.size() > 1)
    say_next(globals,
             fmt::format("diff {} {}   # what changed between the last two",
                         list[list.size() - 2].run.number, list.back().run.number),
             outcome);
  else
    say_next(globals, list.empty() ? "fit" : "compare   # where does it fail?", outcome);
}

}  // namespace

void add_runs(Program& program) {
  program.verb({.name = "runs",
                .summary = "History: every run with its held-out error",
                .examples = "  plumb runs\n  plumb -C mycell runs --json"},
               runs);
}

}  // namespace plumb::offline::cli
