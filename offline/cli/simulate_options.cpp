// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate_options.hpp"

#include <algorithm>

namespace plumb::offline::cli {
namespace {

double share(const std::string& option, const std::string& text) {
  if (const auto value = parse_percent(text)) return *value;
  throw Failure(Exit::kUsage, {Severity::kError, "E-SIM-PLAN", option + " is no share: " + text,
                               std::nullopt, "write " + option + " 2%"});
}

int joint_named(const Cell& cell, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& row : cell.nominal.joints) names.push_back(row.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  throw Failure(Exit::kUsage,
                {Severity::kError, "E-SIM-PLAN", "the arm has no joint '" + name + "'",
                 std::nullopt, "write --coupled-drives " + names.back()});
}

/// What is not as convenient as in a data sheet.
Imperfections imperfections_of(const SimulateOptions& options, const Cell& cell) {
  Imperfections out;
  for (const double urad : options.joint_scatter_urad) out.joint_scatter.push_back(urad * 1e-6);
  out.encoder_step = options.encoder_step_urad * 1e-6;
  if (const auto& g = options.true_gravity; !g.empty()) {
    if (g.size() != 3) {
      throw Failure(Exit::kUsage,
                    {Severity::kError, "E-SIM-PLAN", "gravity is a vector of three numbers",
                     std::nullopt, "write --true-gravity 0,0,-9.81"});
    }
    out.gravity = {g[0], g[1], g[2]};
  }
  for (const auto& name : options.coupled_drives) out.coupled.push_back(joint_named(cell, name));
  return out;
}

void add_arm_options(VerbOptions& verb, SimulateOptions& options) {
  verb.add_option("--geometry-mm", options.geometry_mm, "1 sigma of every length error")
      .type_name("MM")
      .shows_default();
  verb.add_option("--geometry-mrad", options.geometry_mrad, "1 sigma of every angle error")
      .type_name("MRAD")
      .shows_default();
  verb.add_option("--effect,--hidden", options.hidden,
                  "Effect the nominal model lacks: gear_ripple:J2:5 (5 sigma) or "
                  "joint_compliance:J2=150urad; may be repeated")
      .type_name("EFFECT")
      .take_all()
      .one_value_each();
  verb.add_option("--mass-error", options.mass_error, "1 sigma of every mass of the cell")
      .type_name("SHARE")
      .shows_default();
  verb.add_option("--joint-scatter-urad", options.joint_scatter_urad,
                  "1 sigma of an error of each joint that is new at every stop; one for all, or "
                  "one each; of sliding joints in um")
      .type_name("URAD,URAD,...")
      .delimiter(',')
      .one_value_each();
  verb.add_option("--true-gravity", options.true_gravity,
                  "In the base frame, in m/s^2, if it is not what cell.toml says")
      .type_name("X,Y,Z")
      .delimiter(',')
      .one_value_each();
  verb.add_option("--coupled-drives", options.coupled_drives,
                  "Joints that a parallelogram turns, as J3 of palletisers")
      .type_name("JOINT,...")
      .delimiter(',')
      .one_value_each();
  verb.add_option("--richness", options.richness,
                  "Factor on the second-order terms of the hidden laws; 0: without them")
      .type_name("X")
      .shows_default();
  verb.add_flag("--list", options.list, "List the effects that --effect takes");
}

void add_measuring_options(VerbOptions& verb, SimulateOptions& options) {
  verb.add_option("--poses", options.poses, "Distinct poses, uniform inside the joint limits")
      .type_name("N")
      .shows_default();
  verb.add_option("--repeats", options.repeats, "Measure every tenth pose this many times")
      .type_name("N")
      .shows_default();
  verb.add_option("--revisits", options.revisits,
                  "Measure so many of the poses once more at the end of the session")
      .type_name("N")
      .shows_default();
  verb.add_option("--encoder-step-urad", options.encoder_step_urad,
                  "Round the recorded joint angles to multiples of it; of sliding joints in um")
      .type_name("URAD")
      .shows_default();
  verb.add_option("--noise-um,--sigma-um", options.noise_um, "Noise of each axis, 1 sigma")
      .type_name("UM")
      .shows_default();
  verb.add_option("--noise-urad", options.noise_urad, "Measure orientation too, with this noise")
      .type_name("URAD");
  verb.add_flag("--directions", options.directions, "Record how each joint arrived");
  verb.add_option("--outliers", options.outliers, "Share of rows that are far off")
      .type_name("SHARE")
      .shows_default();
  verb.add_option("--held", options.held, "Share of poses that column set holds out")
      .type_name("SHARE")
      .shows_default();
  verb.add_option("--seed", options.seed, "Seed of arm, poses and noise")
      .type_name("N")
      .check(seed_number())
      .shows_default();
}

void add_session_options(VerbOptions& verb, SimulateOptions& options) {
  verb.add_option("--payloads", options.payloads_kg, "Each pose carries one of these, in kg")
      .type_name("KG,KG,...")
      .delimiter(',')
      .one_value_each();
  verb.add_flag("--temperatures", options.temperatures, "Record temperatures");
  verb.add_flag("--constant-temperature", options.constant_temperature, "All at 20 degC");
  verb.add_option("--order", options.order, "Order of the poses")
      .check(one_of({"drawn", "nearest"}))
      .shows_default();
  verb.add_option("--grid", options.grid, "Each joint takes only so many different angles; 0: any")
      .type_name("N")
      .shows_default();
  verb.add_option("--range", options.range, "Share of each joint's range, around its middle")
      .type_name("SHARE")
      .shows_default();
  verb.add_option("--seconds", options.seconds, "Time from row to row")
      .type_name("S")
      .check(greater_than_zero())
      .shows_default();
  verb.add_option("--fresh", options.fresh, "Also fresh poses of the same session, noise-free")
      .type_name("FILE");
  verb.add_option("--fresh-poses", options.fresh_poses, "How many fresh poses")
      .type_name("N")
      .shows_default();
}

void add_file_options(VerbOptions& verb, SimulateOptions& options) {
  verb.add_option("-o,--output", options.output, "Measurements; else the cell's own file")
      .type_name("FILE");
  verb.add_option("--truth", options.truth, "The truth; else truth.json beside cell.toml")
      .type_name("FILE");
  options.write.add_to(verb);
}

}  // namespace

void SimulateOptions::add_to(VerbOptions& verb) {
  add_measuring_options(verb, *this);
  add_session_options(verb, *this);
  add_arm_options(verb, *this);
  add_file_options(verb, *this);
}

SimulationPlan SimulateOptions::plan(const Cell& cell) const {
  SimulationPlan out;
  out.poses = poses;
  out.repeats = repeats;
  out.revisits = revisits;
  out.imperfections = imperfections_of(*this, cell);
  out.noise_m = noise_um * 1e-6;
  if (noise_urad) out.noise_rad = *noise_urad * 1e-6;
  if (directions) out.directions = Recorded::kAlways;
  if (temperatures) out.temperatures = Recorded::kAlways;
  if (constant_temperature) out.climate = SimulationPlan::Climate::kConstant;
  for (const double kg : payloads_kg) out.payloads.push_back({kg, cell.payload.com_m});
  out.outlier_share = share("--outliers", outliers);
  out.held_share = share("--held", held);
  out.choice.range = share("--range", range);
  out.choice.grid_levels = grid;
  if (order == "nearest") out.choice.order = PoseChoice::Order::kNearest;
  out.seconds_per_pose = seconds;
  out.truth.mass_share = share("--mass-error", mass_error);
  out.seed = seed;
  out.truth.geometry_m = geometry_mm * 1e-3;
  out.truth.geometry_rad = geometry_mrad * 1e-3;
  out.truth.richness = richness;
  out.truth.effects = hidden;
  return out;
}

SimulationPlan SimulateOptions::fresh_plan(SimulationPlan plan,
                                           const Simulation& simulation) const {
  const double session_s = simulation.measured.size() * plan.seconds_per_pose;
  plan.truth.seed = plan.truth.seed.value_or(plan.seed);
  plan.truth.sized = simulation.effects;
  plan.truth.effects.clear();
  plan.seed += 1;
  plan.poses = fresh_poses;
  plan.repeats = 1;
  plan.revisits = 0;
  plan.imperfections.joint_scatter.clear();
  plan.imperfections.encoder_step = 0.0;
  plan.noise_m = plan.outlier_share = plan.held_share = 0.0;
  plan.session_s = session_s;
  plan.seconds_per_pose = session_s / std::max(fresh_poses, 1);
  return plan;
}

}  // namespace plumb::offline::cli
