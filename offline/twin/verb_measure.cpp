// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "program/output_files.hpp"
#include "twin/twin_file.hpp"
#include "twin/verbs.hpp"

namespace plumb::offline::twin {
namespace {

namespace fs = std::filesystem;

struct MeasureArguments {
  std::string directory, output;
  int poses = 200;
  int repeats = 3;
  WriteOptions write;
};

void measure(const MeasureArguments& options, Outcome& outcome) {
  const fs::path folder = options.directory;
  const auto [cell, hidden] = open_folder(folder, outcome);
  SimulationPlan plan;
  plan.poses = options.poses;
  plan.repeats = options.repeats;
  plan.noise_m = hidden.noise_m;
  plan.seed = hidden.seed;
  plan.truth = truth_of(cell, hidden);
  const Simulation simulation = simulate(cell, plan);
  const fs::path file =
      options.output.empty() ? folder / "measurements.csv" : fs::path(options.output);
  OutputFiles files;
  files.add(file, simulated_csv(cell, simulation));
  outcome.result = {{"rows", simulation.measured.size()}, {"poses", options.poses}};
  put(outcome.result, "noise_um", hidden.noise_m * 1e6);
  files.commit(options.write, outcome);
  outcome.text = fmt::format(
      "The tracker read {} poses {} times in all, noise {} um per axis.\n\n  {}\n", options.poses,
      simulation.measured.size(), hidden.noise_m * 1e6, wrote(file, options.write));
  outcome.text += fmt::format("\nNext, type\n  plumb -C {} diagnose --apply\n", folder.string());
}

}  // namespace

void add_measure(Program& program) {
  const auto options = std::make_shared<MeasureArguments>();
  VerbOptions verb = program.verb(
      {.name = "measure",
       .summary = "The tracker reads the true arm at random poses: measurements.csv",
       .examples = "  plumb-twin measure mytwin\n  plumb-twin measure mytwin --poses 80 --force"},
      [options](const Globals&, Outcome& o) { measure(*options, o); });
  verb.add_option("DIR", options->directory, "Folder of the twin").required();
  verb.add_option("--poses", options->poses, "Distinct poses, uniform inside the joint limits")
      .check(whole_number_between(1, 100000))
      .shows_default();
  verb.add_option("--repeats", options->repeats, "Read every tenth pose this many times")
      .check(whole_number_between(1, 1000))
      .shows_default();
  verb.add_option("-o,--output", options->output, "Measurements; else measurements.csv in DIR")
      .type_name("FILE");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::twin
