// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
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
  bool temperatures = false;
  bool constant_temperature = false;
  std::vector<double> payloads_kg;
  std::string outliers = "0%", held = "0%", range = "100%", mass_error = "0%";
  std::string order = "drawn";
  int grid = 0;
  double seconds = 30.0;
  int fresh_poses = 500;
  bool list = false;
  std::string output, truth, fresh;
  WriteOptions write;
};

double share(const std::string& option, const std::string& text) {
  if (const auto value = parse_percent(text)) return *value;
  throw Failure(Exit::kUsage, {Severity::kError, "E-SIM-PLAN", option + " is no share: " + text,
                               std::nullopt, "write " + option + " 2%"});
}

SimulationPlan plan_of(const Options& options, const Cell& cell) {
  SimulationPlan plan;
  plan.poses = options.poses;
  plan.repeats = options.repeats;
  plan.noise_m = options.noise_um * 1e-6;
  if (options.noise_urad) plan.noise_rad = *options.noise_urad * 1e-6;
  if (options.directions) plan.directions = Recorded::kAlways;
  if (options.temperatures) plan.temperatures = Recorded::kAlways;
  if (options.constant_temperature) plan.climate = SimulationPlan::Climate::kConstant;
  for (const double kg : options.payloads_kg) plan.payloads.push_back({kg, cell.payload.com_m});
  plan.outlier_share = share("--outliers", options.outliers);
  plan.held_share = share("--held", options.held);
  plan.choice.range = share("--range", options.range);
  plan.choice.grid_levels = options.grid;
  if (options.order == "nearest") plan.choice.order = PoseChoice::Order::kNearest;
  plan.seconds_per_pose = options.seconds;
  plan.truth.mass_share = share("--mass-error", options.mass_error);
  plan.seed = options.seed;
  plan.truth.geometry_m = options.geometry_mm * 1e-3;
  plan.truth.geometry_rad = options.geometry_mrad * 1e-3;
  plan.truth.effects = options.hidden;
  return plan;
}

// The same arm and session at other poses, read without noise.
SimulationPlan fresh_plan(SimulationPlan plan, const Simulation& simulation, int poses) {
  const double session_s = simulation.measured.size() * plan.seconds_per_pose;
  plan.truth.seed = plan.truth.seed.value_or(plan.seed);
  plan.truth.sized = simulation.effects;
  plan.truth.effects.clear();
  plan.seed += 1;
  plan.poses = poses;
  plan.repeats = 1;
  plan.noise_m = plan.outlier_share = plan.held_share = 0.0;
  plan.session_s = session_s;
  plan.seconds_per_pose = session_s / std::max(poses, 1);
  return plan;
}

Json sizes_json(const Simulation& simulation) {
  Json out = Json::array();
  for (std::size_t k = 0; k < simulation.effects.size(); ++k) {
    out.push_back({{"effect", simulation.effects[k].name},
                   {"visible_um", simulation.sizes[k].visible_m * 1e6},
                   {"rms_um", simulation.sizes[k].rms_m * 1e6}});
  }
  return out;
}

std::string sizes_text(const Simulation& simulation) {
  std::string out;
  if (!simulation.effects.empty()) {
    out = "  hidden, per-axis RMS [um]    all  visible after geometry is fitted\n";
  }
  for (std::size_t k = 0; k < simulation.effects.size(); ++k) {
    out += fmt::format("  {:<24} {:>7.1f}  {:>7.1f}\n", simulation.effects[k].name,
                       simulation.sizes[k].rms_m * 1e6, simulation.sizes[k].visible_m * 1e6);
  }
  return out.empty() ? out : out + "\n";
}

void list_effects(Outcome& outcome) {
  outcome.result = {{"effects", Json::array()}};
  outcome.text =
      "Effects that --effect takes, as NAME[=SIZE][:JOINT[=SIZE],...][:SIGMA][@KEY=NUMBER,...]\n"
      "SIGMA: visible size over the noise, geometry having been fitted\n\n";
  for (const auto& [name, line] : simulated_effects()) {
    outcome.result["effects"].push_back({{"effect", name}, {"about", line}});
    outcome.text += fmt::format("  {:<22} {}\n", name, line);
  }
}

void simulate_cell(const Options& options, const Globals& globals, Outcome& outcome) {
  if (options.list) return list_effects(outcome);
  const Cell cell = open_cell(globals, outcome);
  const Progress progress(fmt::format("simulating {} poses", options.poses));
  const SimulationPlan plan = plan_of(options, cell);
  const Simulation simulation = simulate(cell, plan);
  const fs::path usual = cell.measurement.files.empty() ? cell.directory / "measurements.csv"
                                                        : cell.measurement.files.front();
  const fs::path data = options.output.empty() ? usual : fs::path(options.output);
  const fs::path truth =
      options.truth.empty() ? cell.directory / "truth.json" : fs::path(options.truth);
  OutputFiles files;
  files.add(data, simulated_csv(cell, simulation));
  files.add(truth, simulation.truth_json);
  if (!options.fresh.empty()) {
    const Simulation fresh = simulate(cell, fresh_plan(plan, simulation, options.fresh_poses));
    files.add(options.fresh, simulated_csv(cell, fresh));
  }
  outcome.result = {{"rows", simulation.measured.size()},
                    {"poses", options.poses},
                    {"noise_um", options.noise_um},
                    {"seed", options.seed},
                    {"hidden", options.hidden},
                    {"sizes", sizes_json(simulation)},
                    {"outliers", simulation.outliers.size()}};
  files.commit(options.write, outcome);
  outcome.text = fmt::format(
      "Simulated {} measurements of {} poses, noise {} um per axis.\n\n"
      "{}  {}\n  {}\n",
      simulation.measured.size(), options.poses, options.noise_um, sizes_text(simulation),
      wrote(data, options.write), wrote(truth, options.write));
  if (!options.fresh.empty()) {
    outcome.text += fmt::format("  {}\n", wrote(options.fresh, options.write));
  }
}

void add_arm_options(CLI::App& verb, Options& options) {
  verb.add_option("--geometry-mm", options.geometry_mm, "1 sigma of every length error")
      ->type_name("MM")
      ->capture_default_str();
  verb.add_option("--geometry-mrad", options.geometry_mrad, "1 sigma of every angle error")
      ->type_name("MRAD")
      ->capture_default_str();
  verb.add_option("--effect,--hidden", options.hidden,
                  "Effect the nominal model lacks: gear_ripple:J2:5 (5 sigma) or "
                  "joint_compliance:J2=150urad; may be repeated")
      ->type_name("EFFECT")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--mass-error", options.mass_error, "1 sigma of every mass of the cell")
      ->type_name("SHARE")
      ->capture_default_str();
  verb.add_flag("--list", options.list, "List the effects that --effect takes");
}

void add_measuring_options(CLI::App& verb, Options& options) {
  verb.add_option("--poses", options.poses, "Distinct poses, uniform inside the joint limits")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--repeats", options.repeats, "Measure every tenth pose so often")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--noise-um,--sigma-um", options.noise_um, "Noise of each axis, 1 sigma")
      ->type_name("UM")
      ->capture_default_str();
  verb.add_option("--noise-urad", options.noise_urad, "Measure orientation too, with this noise")
      ->type_name("URAD");
  verb.add_flag("--directions", options.directions, "Record how each joint arrived");
  verb.add_option("--outliers", options.outliers, "Share of rows that are far off")
      ->type_name("SHARE")
      ->capture_default_str();
  verb.add_option("--held", options.held, "Share of poses that column set holds out")
      ->type_name("SHARE")
      ->capture_default_str();
  verb.add_option("--seed", options.seed, "Seed of arm, poses and noise")
      ->type_name("N")
      ->capture_default_str();
}

void add_session_options(CLI::App& verb, Options& options) {
  verb.add_option("--payloads", options.payloads_kg, "Each pose carries one of these, in kg")
      ->type_name("KG,KG,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_flag("--temperatures", options.temperatures, "Record temperatures");
  verb.add_flag("--constant-temperature", options.constant_temperature, "All at 20 degC");
  verb.add_option("--order", options.order, "Order of the poses")
      ->check(CLI::IsMember({"drawn", "nearest"}))
      ->capture_default_str();
  verb.add_option("--grid", options.grid, "Joints only on so many places each; 0: anywhere")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--range", options.range, "Share of each joint's range, around its middle")
      ->type_name("SHARE")
      ->capture_default_str();
  verb.add_option("--seconds", options.seconds, "Time from row to row")
      ->type_name("S")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb.add_option("--fresh", options.fresh, "Also fresh poses of the same session, noise-free")
      ->type_name("FILE");
  verb.add_option("--fresh-poses", options.fresh_poses, "How many")
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

void add_simulate(Program& program) {
  const auto options = std::make_shared<Options>();
  CLI::App& verb = program.verb(
      {.name = "simulate",
       .summary = "Measurements of a simulated arm with chosen errors, hidden effects and noise",
       .examples =
           "  plumb -C mycell simulate --poses 150 --noise-um 10 --seed 7\n"
           "  plumb -C mycell simulate --effect gear_ripple:J2:5 --outliers 2% --repeats 3"},
      [options](const Globals& g, Outcome& o) { simulate_cell(*options, g, o); });
  add_measuring_options(verb, *options);
  add_session_options(verb, *options);
  add_arm_options(verb, *options);
  verb.add_option("-o,--output", options->output, "Measurements; else the cell's own file")
      ->type_name("FILE");
  verb.add_option("--truth", options->truth, "The truth; else truth.json beside cell.toml")
      ->type_name("FILE");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
