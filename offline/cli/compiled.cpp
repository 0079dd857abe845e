// SPDX-License-Identifier: Apache-2.0
#include "cli/compiled.hpp"

#include <fmt/format.h>

#include "cli/progress.hpp"
#include "compile/compiler.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {

void CompileOptions::add_to(CLI::App& verb) {
  verb.add_flag("--refit-all", refit_all,
                "Use every pose; the model then carries no held-out figure");
  verb.add_flag("--gate", gate,
                "Exit 1 and write nothing if the audit warns or 95 % of the held-out poses are not "
                "within tolerance");
}

format::Model compiled(const Cell& cell, const CompileOptions& options, const WriteOptions& write,
                       Outcome& outcome) {
  Measurements measured = open_measurements(cell, outcome);
  Run run =
      current_or_new_run(cell, measured, write.dry_run ? Keep::kNothing : Keep::kRun, outcome);
  check_known_to_runtime(run, cell, measured);
  const std::string kept = run.number > 0 ? fmt::format("{:04}", run.number) : "not kept";
  if (options.refit_all) {
    const Progress progress("calibrating on every pose");
    stand_on_base_of(run, cell, measured);
    run = draft_run(cell, measured, fit_all(cell, measured));
  }
  format::Model model = compile(cell, run);
  model.provenance.run = options.refit_all ? kept + ", refitted on all poses" : kept;
  return model;
}

void check_gate(const Audit& audit, const format::Model& model, double tolerance_m,
                Outcome& outcome) {
  const auto fail = [&](const std::string& why) {
    outcome.exit = Exit::kGateFailed;
    outcome.errors.push_back({.code = "E-GATE",
                              .message = "--gate: " + why + "; nothing was written",
                              .help = "to write it nevertheless, leave out --gate"});
  };
  for (const auto& remark : audit.remarks)
    if (remark.severity == Severity::kWarning) fail(remark.message);
  const auto& held = model.provenance.held_out;
  if (held.poses > 0 && held.p95_m > tolerance_m)
    fail(fmt::format("the held-out error at 95 %, {} mm, exceeds the tolerance of {} mm",
                     show::mm(held.p95_m), show::mm(tolerance_m)));
}

std::string compiled_headline(const format::Model& model) {
  const auto& held = model.provenance.held_out;
  const std::string error = held.poses == 0
                                ? "no held-out figure"
                                : fmt::format("held-out mean {} mm, 95 % {} mm",
                                              show::mm(held.mean_m), show::mm(held.p95_m));
  return fmt::format("Compiled {} for {} (serial {}): {}.\n\n", model.cell_name, model.robot_name,
                     model.serial, error);
}

}  // namespace plumb::offline::cli
