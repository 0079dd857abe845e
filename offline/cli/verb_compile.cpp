// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/cell_data.hpp"
#include "cli/compiled.hpp"
#include "cli/model_file.hpp"
#include "cli/next_line.hpp"
#include "cli/verbs.hpp"
#include "compile/audit.hpp"
#include "program/output_files.hpp"
#include "program/shell_word.hpp"
#include "show/audit_view.hpp"
#include "show/cost_view.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

struct CompileArguments {
  std::string output;
  CompileOptions compile;
  WriteOptions write;
};

Json result_of(const Compiled& made, const Audit& audit, const bench::StepCost& cost,
               const std::string& file) {
  const auto& held = made.model.provenance.held_out;
  Json out{{"model", file}};
  made.put_run(out);
  out["held_out"] = show::stats_json({.n = static_cast<int>(held.poses),
                                      .mean = held.mean_m,
                                      .rms = held.rms_m,
                                      .p95 = held.p95_m,
                                      .max = held.max_m});
  out["verdict_error"] = show::stats_json(made.held);
  out["audit"] = show::audit_json(audit, made.model);
  out["cost"] = show::cost_json(cost);
  return out;
}

void compile_cell(const CompileArguments& options, const Globals& globals, Outcome& outcome) {
  Cell cell = open_cell(globals, outcome, Makes::kModel);
  const fs::path file =
      options.output.empty() ? cell.directory / "robot.plumb" : fs::path(options.output);
  OutputFiles before;
  before.add(file, "");
  before.check(options.write, outcome);
  const Compiled made = compiled(cell, options.compile, options.write, outcome);
  const format::Model& model = made.model;
  const Audit found = audit(model);
  outcome.remark(found.remarks);
  const bench::StepCost cost = bench::step_cost(model);
  outcome.result = result_of(made, found, cost, file.string());
  const std::string text = compiled_headline(made, cell.tolerance_m) +
                           show::audit_text(found, model) + show::cost_text(cost);
  if (options.compile.gate) check_gate(found, made, cell.tolerance_m, outcome);
  if (!outcome.errors.empty()) {
    outcome.text = text;
    return say_next(globals, "compare   # where does the model fail?", outcome);
  }
  OutputFiles files;
  files.add(file, model_bytes(model));
  files.commit(options.write, outcome);
  outcome.text = text + "\n" + wrote(file, options.write) + "\n";
  say_next({},
           fmt::format("inspect {}   # what the controller will get", shell_word(file.string())),
           outcome);
}

}  // namespace

void add_compile(Program& program) {
  const auto options = std::make_shared<CompileArguments>();
  VerbOptions verb = program.verb(
      {.name = "compile",
       .summary = "Make the model file for the controller, and audit it",
       .examples = "  plumb compile\n  plumb -C mycell compile -o robot.plumb --gate --force"},
      [options](const Globals& g, Outcome& o) { compile_cell(*options, g, o); });
  verb.add_option("-o,--output", options->output, "Model file; else robot.plumb beside cell.toml")
      .type_name("FILE");
  options->compile.add_to(verb);
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
