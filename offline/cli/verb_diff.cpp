// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "cli/cell_data.hpp"
#include "cli/run_number.hpp"
#include "cli/verbs.hpp"
#include "runs/run_store.hpp"
#include "show/runs_view.hpp"

namespace plumb::offline::cli {
namespace {

struct DiffArguments {
  std::string a, b;
};

void diff(const DiffArguments& options, const Globals& globals, Outcome& outcome) {
  const Cell cell = open_cell(globals, outcome);
  const Run a = load_run(cell, run_number(options.a));
  const Run b = load_run(cell, run_number(options.b));
  outcome.result = show::diff_json(a, b);
  outcome.text = show::diff_text(a, b);
}

}  // namespace

void add_diff(Program& program) {
  const auto options = std::make_shared<DiffArguments>();
  VerbOptions verb =
      program.verb({.name = "diff",
                    .summary = "What changed between two runs, and what it did to the error",
                    .examples = "  plumb diff 1 2\n  plumb -C mycell diff 0001 0002 --json"},
                   [options](const Globals& g, Outcome& o) { diff(*options, g, o); });
  verb.add_option("A", options->a, "The earlier run").required();
  verb.add_option("B", options->b, "The later run").required();
}

}  // namespace plumb::offline::cli
