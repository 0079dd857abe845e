// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/demo_targets.hpp"
#include "cli/verbs.hpp"
#include "program/output_files.hpp"
#include "simulate/simulate.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kTargets = 20;
constexpr double kLargestCorrection_m = 5e-3;  // of the heavy arm 3.7 mm

struct DemoArguments {
  std::string name, directory;
  bool list = false;
  WriteOptions write;
};

void list_demos(Outcome& outcome) {
  outcome.result = {{"demos", Json::array()}};
  outcome.text = "Sample cells of plumb demo; the first is the default\n\n";
  for (const auto& [name, line] : demo_cells()) {
    outcome.result["demos"].push_back({{"name", name}, {"about", line}});
    outcome.text += fmt::format("  {:<18} {}\n", name, line);
  }
}

std::string next_steps(const std::string& folder) {
  return fmt::format(
      "\nNext, type\n"
      "  plumb -C {0} fit\n"
      "  plumb -C {0} compare\n"
      "  plumb -C {0} diagnose\n"
      "  plumb -C {0} diagnose --apply\n"
      "  plumb -C {0} compile\n"
      "  plumb predict {0}/robot.plumb --data {0}/measurements.csv -o {0}/predicted.csv\n"
      "  plumb correct {0}/robot.plumb --data {0}/targets.csv -o {0}/corrected.csv\n",
      folder);
}

void make_cell(const DemoArguments& options, Outcome& outcome) {
  Demo demo = make_demo(options.name);
  const std::string name = options.name.empty() ? demo_cells().front().first : options.name;
  const fs::path folder = options.directory.empty() ? "demo-" + name : options.directory;
  demo.cell.directory = fs::absolute(folder);
  demo.cell.deploy.max_correction_m = kLargestCorrection_m;
  demo.cell.measurement.files = {demo.cell.directory / "measurements.csv"};
  const Simulation simulation = simulate(demo.cell, demo.plan);
  OutputFiles files(folder);
  files.add(folder / "cell.toml", write_cell(demo.cell));
  files.add(folder / "measurements.csv", simulated_csv(demo.cell, simulation));
  files.add(folder / "truth.json", simulation.truth_json);
  files.add(folder / "targets.csv", demo_targets(demo.cell, kTargets));
  outcome.result = {{"demo", name},
                    {"directory", folder.string()},
                    {"rows", simulation.measured.size()},
                    {"targets", kTargets}};
  files.commit(options.write, outcome);
  outcome.text = fmt::format(
      "{}: {} simulated measurements; what is hidden stands in truth.json.\n\n"
      "  {}\n",
      demo.cell.name, simulation.measured.size(),
      wrote(folder / "{cell.toml,measurements.csv,truth.json,targets.csv}", options.write));
  outcome.text += next_steps(folder.string());
}

void demo(const DemoArguments& options, const Globals&, Outcome& outcome) {
  if (options.list) return list_demos(outcome);
  make_cell(options, outcome);
}

}  // namespace

void add_demo(Program& program) {
  const auto options = std::make_shared<DemoArguments>();
  VerbOptions verb =
      program.verb({.name = "demo",
                    .summary = "Write a sample cell with simulated measurements, to try everything",
                    .examples = "  plumb demo\n  plumb demo gear mycell",
                    .in_cell = false},
                   [options](const Globals& g, Outcome& o) { demo(*options, g, o); });
  verb.add_option("NAME", options->name, "Which one; see --list");
  verb.add_option("DIR", options->directory, "Folder to write into; else demo-NAME");
  verb.add_flag("--list", options->list, "List the sample cells");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
