// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/model_file.hpp"
#include "cli/next_line.hpp"
#include "cli/verbs.hpp"
#include "compile/audit.hpp"
#include "plumb/format/version.hpp"
#include "program/shell_word.hpp"
#include "show/audit_view.hpp"
#include "show/cost_view.hpp"
#include "show/model_view.hpp"

namespace plumb::offline::cli {
namespace {

void inspect(const std::string& file, Outcome& outcome) {
  const format::Model model = open_model(file, outcome);
  const Audit found = audit(model);
  outcome.remark(found.remarks);
  outcome.result = {{"file", file}, {"sound", true}, {"schema_read", format::kSchemaVersion}};
  outcome.result.update(show::model_json(model));
  outcome.result["audit"] = show::audit_json(found, model);
  const bench::StepCost cost = bench::step_cost(model);
  outcome.result["cost"] = show::cost_json(cost);
  outcome.text =
      fmt::format("{} is sound: checksum, structure and every number are in order.\n\n", file) +
      show::model_text(model) + "\n" + show::audit_text(found, model) + show::cost_text(cost);
  say_next({}, fmt::format("bench {}   # what a cycle costs with it", shell_word(file)), outcome);
}

}  // namespace

void add_inspect(Program& program) {
  const auto file = std::make_shared<std::string>();
  VerbOptions verb =
      program.verb({.name = "inspect",
                    .summary = "What is in a model file, and whether it is sound",
                    .examples = "  plumb inspect robot.plumb\n  plumb inspect robot.plumb --json",
                    .in_cell = false},
                   [file](const Globals&, Outcome& o) { inspect(*file, o); });
  verb.add_option("FILE", *file, "Model file").required();
}

}  // namespace plumb::offline::cli
