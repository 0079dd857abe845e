// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/cell_data.hpp"
#include "cli/compiled.hpp"
#include "cli/model_file.hpp"
#include "cli/next_line.hpp"
#include "cli/verbs.hpp"
#include "compile/audit.hpp"
#include "compile/emit_c.hpp"
#include "program/output_files.hpp"
#include "program/shell_word.hpp"
#include "show/audit_view.hpp"
#include "show/cost_view.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

struct CompileArguments {
  std::string output;
  std::string c_output;
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

/// The path of the model file. Refused if --emit-c names the same file.
fs::path model_file(const CompileArguments& options, const Cell& cell) {
  fs::path file =
      options.output.empty() ? cell.directory / "robot.plumb" : fs::path(options.output);
  if (!options.c_output.empty() &&
      fs::weakly_canonical(file) == fs::weakly_canonical(options.c_output))
    throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                 .message = fmt::format("--emit-c names the model file itself, {}",
                                                        file.string()),
                                 .help = "for example: plumb compile --emit-c robot.h"});
  return file;
}

/// The model, and if asked for the same tree as C; without a model, their names alone.
OutputFiles files_of(const CompileArguments& options, const fs::path& file,
                     const format::Model* model = nullptr) {
  OutputFiles out;
  out.add(file, model ? model_bytes(*model) : "");
  if (!options.c_output.empty())
    out.add(options.c_output, model ? emit_c(*model, options.c_output) : "");
  return out;
}

std::string wrote_text(const CompileArguments& options, const fs::path& file) {
  std::string out = wrote(file, options.write) + "\n";
  if (!options.c_output.empty()) out += wrote(options.c_output, options.write) + "\n";
  return out;
}

void compile_cell(const CompileArguments& options, const Globals& globals, Outcome& outcome) {
  const Cell cell = open_cell(globals, outcome, Makes::kModel);
  const fs::path file = model_file(options, cell);
  files_of(options, file).check(options.write, outcome);
  const Compiled made = compiled(cell, options.compile, options.write, outcome);
  const format::Model& model = made.model;
  const OutputFiles files = files_of(options, file, &model);
  const Audit found = audit(model);
  outcome.remark(found.remarks);
  const bench::StepCost cost = bench::step_cost(model);
  outcome.result = result_of(made, found, cost, file.string());
  if (!options.c_output.empty()) outcome.result["c"] = options.c_output;
  const std::string text = compiled_headline(made, cell.tolerance_m) +
                           show::audit_text(found, model) + show::cost_text(cost);
  if (options.compile.gate) check_gate(found, made, cell.tolerance_m, outcome);
  if (!outcome.errors.empty()) {
    outcome.text = text;
    return say_next(globals, "compare   # where does the model fail?", outcome);
  }
  files.commit(options.write, outcome);
  outcome.text = text + "\n" + wrote_text(options, file);
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
  verb.add_option(
          "--emit-c", options->c_output,
          "Also write the tree as one C99 header that needs nothing else; its symbols begin "
          "with the file's name")
      .type_name("FILE");
  options->compile.add_to(verb);
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
