// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/cell_data.hpp"
#include "cli/output_files.hpp"
#include "cli/progress.hpp"
#include "cli/verbs.hpp"
#include "simulate/simulate.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  int poses = 150;
  int repeats = 1;
  double noise_um = 10.0;
  std::optional<double> noise_urad;
  double geometry_mm = 0.3;
  double geometry_mrad = 0.3;
  std::uint64_t seed = 1;
  std::vector<std::string> hidden;
  bool directions = false;
  bool list = false;
  std::string output, truth;
  WriteOptions write;
};

SimulationPlan plan_of(const Options& options) {
  SimulationPlan plan;
  plan.poses = options.poses;
  plan.repeats = options.repeats;
  plan.noise_m = options.noise_um * 1e-6;
  if (options.noise_urad) plan.noise_rad = *options.noise_urad * 1e-6;
  if (options.directions) plan.directions = SimulationPlan::Directions::kRecorded;
  plan.seed = options.seed;
  plan.truth.geometry_m = options.geometry_mm * 1e-3;
  plan.truth.geometry_rad = options.geometry_mrad * 1e-3;
  plan.truth.effects = options.hidden;
  return plan;
}

void list_effects(Outcome& outcome) {
  outcome.result = {{"effects", Json::array()}};
  outcome.text = "Effects that --hidden takes, as NAME[=SIZE][:JOINT[=SIZE],...]\n\n";
  for (const auto& [name, line] : simulated_effects()) {
    outcome.result["effects"].push_back({{"effect", name}, {"about", line}});
    outcome.text += fmt::format("  {:<22} {}\n", name, line);
  }
}

void simulate_cell(const Options& options, const Globals& globals, Outcome& outcome) {
  if (options.list) return list_effects(outcome);
  const Cell cell = open_cell(globals, outcome);
  const Progress progress(fmt::format("simulating {} poses", options.poses));
  const Simulation simulation = simulate(cell, plan_of(options));
  const fs::path usual = cell.measurement.files.empty() ? cell.directory / "measurements.csv"
                                                        : cell.measurement.files.front();
  const fs::path data = options.output.empty() ? usual : fs::path(options.output);
  const fs::path truth =
      options.truth.empty() ? cell.directory / "truth.json" : fs::path(options.truth);
  OutputFiles files;
  files.add(data, simulated_csv(cell, simulation));
  files.add(truth, simulation.truth_json);
  outcome.result = {{"rows", simulation.measured.size()},
                    {"poses", options.poses},
                    {"noise_um", options.noise_um},
                    {"seed", options.seed},
                    {"hidden", options.hidden}};
  files.commit(options.write, outcome);
  outcome.text = fmt::format(
      "Simulated {} measurements of {} poses, noise {} um per axis.\n\n"
      "  {}\n  {}\n",
      simulation.measured.size(), options.poses, options.noise_um, wrote(data, options.write),
      wrote(truth, options.write));
}

void add_arm_options(CLI::App& verb, Options& options) {
  verb.add_option("--geometry-mm", options.geometry_mm, "1 sigma of every length error")
      ->type_name("MM")
      ->capture_default_str();
  verb.add_option("--geometry-mrad", options.geometry_mrad, "1 sigma of every angle error")
      ->type_name("MRAD")
      ->capture_default_str();
  verb.add_option("--hidden", options.hidden,
                  "Effect the nominal model lacks, for example joint_compliance:J2=150urad; may be "
                  "repeated")
      ->type_name("EFFECT")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_flag("--list", options.list, "List the effects that --hidden takes");
}

void add_measuring_options(CLI::App& verb, Options& options) {
  verb.add_option("--poses", options.poses, "Distinct poses, uniform inside the joint limits")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--repeats", options.repeats, "Measure every tenth pose so often")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--noise-um", options.noise_um, "Noise of each axis, 1 sigma")
      ->type_name("UM")
      ->capture_default_str();
  verb.add_option("--noise-urad", options.noise_urad, "Measure orientation too, with this noise")
      ->type_name("URAD");
  verb.add_flag("--directions", options.directions, "Record how each joint arrived");
  verb.add_option("--seed", options.seed, "Seed of arm, poses and noise")
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

void add_simulate(Program& program) {
  const auto options = std::make_shared<Options>();
  CLI::App& verb = program.verb(
      {.name = "simulate",
       .summary = "Measurements of a simulated arm with chosen errors, hidden effects and noise",
       .examples = "  plumb -C mycell simulate --poses 150 --noise-um 10 --seed 7\n"
                   "  plumb -C mycell simulate --hidden joint_compliance:J2=150urad --repeats 3"},
      [options](const Globals& g, Outcome& o) { simulate_cell(*options, g, o); });
  add_measuring_options(verb, *options);
  add_arm_options(verb, *options);
  verb.add_option("-o,--output", options->output, "Measurements; else the cell's own file")
      ->type_name("FILE");
  verb.add_option("--truth", options->truth, "The truth; else truth.json beside cell.toml")
      ->type_name("FILE");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
