// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/cell_data.hpp"
#include "cli/cell_writing.hpp"
#include "cli/next_line.hpp"
#include "cli/progress.hpp"
#include "cli/repair.hpp"
#include "cli/verbs.hpp"
#include "show/check_view.hpp"

namespace plumb::offline::cli {
namespace {

struct CheckArguments {
  bool fix = false;
  WriteOptions write;
};

void hand_over(const Check& check, Outcome& outcome) {
  for (const auto& problem : check.findings)
    (problem.severity == Severity::kError ? outcome.errors : outcome.remarks).push_back(problem);
  outcome.exit = check.exit;
}

/// What was wrong with the labels is put right; the rest stands.
void fix(const CheckArguments& options, const Cell& cell, const MeasurementFiles& measured,
         const Check& check, Outcome& outcome) {
  if (!can_be_fixed(check)) {
    outcome.result["files"] = Json::array();
    outcome.result["dry_run"] = options.write.dry_run;
    outcome.text += "\nnothing to fix: the files are meant as they are labelled\n";
    return;
  }
  outcome.text += "\n" + repair(cell, measured, check, options.write, outcome);
  std::erase_if(outcome.errors, [](const Problem& p) {
    return p.code == "E-CHECK-CONVENTION" || p.code == "E-CHECK-ORIENTATION";
  });
  if (outcome.errors.empty()) outcome.exit = Exit::kDone;
  outcome.result["ok"] = outcome.errors.empty();
  bool turned = false;
  const Convention& meant = check.detection.best.convention;
  for (std::size_t j = 0; j < meant.reversed.size(); ++j)
    turned = turned || meant.reversed[j] || meant.factor[j] != 1.0;
  if (turned)
    outcome.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-CHECK-DIRECTION",
         .message = "the cell and the new measurements count some joints otherwise than the old "
                    "files did",
         .help = "count them that way in the targets too, and on the controller"});
}

void check(const CheckArguments& options, const Globals& globals, Outcome& outcome) {
  Cell cell = options.fix && !options.write.dry_run ? open_cell_to_change(globals, outcome)
                                                    : open_cell(globals, outcome);
  const MeasurementFiles measured = open_measurements(cell, outcome);
  const Progress progress(fmt::format("checking {} rows", measured.size()));
  const Check found = check_cell(cell, measured);
  outcome.result = show::check_json(cell, found);
  outcome.verdicts = {show::check_verdict(found)};
  put(show::check_blocks(cell, found), outcome);
  hand_over(found, outcome);
  if (options.fix) fix(options, cell, measured, found, outcome);
  const bool to_fix = can_be_fixed(found) && !options.fix;
  if (to_fix)
    say_next(globals, "check --fix   # writes the files as they are meant", outcome);
  else if (outcome.exit == Exit::kDone)
    say_next(globals, found.moved.empty() ? "fit" : "compare   # what moved, and when?", outcome);
}

}  // namespace

void add_check(Program& program) {
  const auto options = std::make_shared<CheckArguments>();
  VerbOptions verb = program.verb(
      {.name = "check",
       .summary = "Units, conventions, duplicates, limits, coverage, and what the data can show",
       .examples = "  plumb check                       # is the cell meant as it is labelled?\n"
                   "  plumb -C mycell check --fix       # and if not, put it right"},
      [options](const Globals& g, Outcome& o) { check(*options, g, o); });
  verb.add_flag("--fix", options->fix,
                "Write the reading that fits: cell.toml in place, measurements as NAME_fixed.csv");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
