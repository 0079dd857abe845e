// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/cell_data.hpp"
#include "cli/run_number.hpp"
#include "cli/verbs.hpp"
#include "program/output_files.hpp"
#include "runs/run_store.hpp"
#include "urdf/urdf_writer.hpp"

namespace plumb::offline::cli {
namespace {

struct ExportArguments {
  std::string run;
  std::string output = "robot.urdf";
  bool nominal = false;
  bool urdf = true;
  WriteOptions write;
};

/// What a rigid chain cannot express.
void warn_of_losses(const format::Model& arm, Outcome& outcome) {
  std::vector<std::string> lost;
  for (const auto& effect : arm.effects) lost.push_back(effect.name);
  for (const auto& tree : arm.trees)
    if (!tree.bounds.empty()) {
      lost.emplace_back("local_tree");
      break;
    }
  for (const auto& row : arm.calibrated.joints)
    if (row.scale != 1.0) lost.push_back("encoder scale of " + row.name);
  for (const auto& [joint, by, ratio] : arm.calibrated.coupling)
    lost.push_back(fmt::format("coupling of {} with {}: its joints count their own angles",
                               arm.calibrated.joints[joint].name, arm.calibrated.joints[by].name));
  if (lost.empty()) return;
  outcome.remarks.push_back({.severity = Severity::kWarning,
                             .code = "W-EXPORT-LOST",
                             .message = fmt::format("URDF holds rigid geometry only; left out: {}",
                                                    fmt::join(lost, ", ")),
                             .help = "the whole model: plumb compile"});
}

void run_export(const ExportArguments& options, const Globals& globals, Outcome& outcome) {
  Cell cell = open_cell(globals, outcome);
  OutputFiles before;
  before.add(options.output, "");
  before.check(options.write, outcome);
  format::Model arm;
  std::string what = "nominal arm";
  if (options.nominal) {
    arm.calibrated = cell.nominal;
  } else {
    MeasurementFiles measured = open_measurements(cell, outcome);
    const Run run =
        options.run.empty()
            ? current_or_new_run(cell, measured,
                                 options.write.dry_run ? Keep::kNothing : Keep::kRun, outcome)
            : load_run(cell, run_number(options.run));
    stand_on_base_of(run, cell, measured);
    check_known_to_runtime(run, measured);
    arm = run.fit.calibration.state.arm;
    what = fmt::format("calibrated arm of run {}", run.number);
    outcome.result["run"] = run.number;
  }
  warn_of_losses(arm, outcome);
  OutputFiles files;
  files.add(options.output, write_urdf(cell.robot_name, arm.calibrated));
  outcome.result["joints"] = cell.joints();
  files.commit(options.write, outcome);
  outcome.text = fmt::format("The {} as URDF: {} joints, base_link to tool0.\n\n{}\n", what,
                             cell.joints(), wrote(options.output, options.write));
}

}  // namespace

void add_export(Program& program) {
  const auto options = std::make_shared<ExportArguments>();
  VerbOptions verb = program.verb(
      {.name = "export",
       .summary = "The calibrated arm as URDF, for planners and simulators",
       .examples =
           "  plumb export -o robot.urdf\n  plumb -C mycell export --run 3 -o arm.urdf --force"},
      [options](const Globals& g, Outcome& o) { run_export(*options, g, o); });
  verb.add_option("-o,--output", options->output, "Where to write").type_name("FILE");
  verb.add_option("--run", options->run, "Which run; else the latest of the present cell and data")
      .type_name("N");
  verb.add_flag("--nominal", options->nominal, "The nominal arm instead of the calibrated one");
  verb.add_flag("--urdf", options->urdf, "As URDF, which is the only format so far");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
