// SPDX-License-Identifier: Apache-2.0
#include "simulate/blind_case.hpp"

#include <algorithm>
#include <numbers>

#include "simulate/law_list.hpp"
#include "simulate/planar.hpp"
#include "simulate/random.hpp"
#include "simulate/study_arms.hpp"

namespace plumb::offline {
namespace {

using Domain = sim::LawEntry::Domain;
using sim::Random;
using sim::Vector3d;

constexpr double kGeometry_m = 0.4e-3;
constexpr double kGeometry_rad = 0.4e-3;
constexpr double kMassShare = 0.15;

bool is_planar(BlindArm arm) {
  return arm == BlindArm::kPlanarPublished || arm == BlindArm::kPlanarPrinted;
}

Cell cell_of(const BlindRequest& request) {
  if (request.arm == BlindArm::kPlanarPublished) return planar_cell(PlanarVariant::kPublished);
  if (request.arm == BlindArm::kPlanarPrinted) return planar_cell(PlanarVariant::kPrinted);
  const bool heavy = request.arm == BlindArm::kHeavy;
  Cell cell = heavy ? sim::heavy_arm() : sim::light_arm();
  cell.name = "Blind case " + std::to_string(request.seed);
  cell.serial = "BLIND-" + std::to_string(request.seed);
  cell.robot_name = heavy ? "Heavy six-axis arm" : "Light six-axis arm";
  sim::state_masses(cell, heavy ? 420.0 : 26.0);
  cell.payload.mass_kg = heavy ? 60.0 : 6.0;
  cell.payload.com_m = {0.03, 0.01, 0.08};
  return cell;
}

// Three payloads: the tool alone, about half the load, and nearly the full load.
std::vector<Payload> three_payloads(const Cell& cell, Random random) {
  std::vector<Payload> out;
  for (const double share : {0.15, 0.55, 1.0}) {
    Payload payload = cell.payload;
    payload.mass_kg = share * cell.payload.mass_kg;
    for (double& c : payload.com_m) c += share * 0.05 * random.uniform(-1.0, 1.0);
    out.push_back(payload);
  }
  return out;
}

// An upright tracker on its stand, 3.5 to 5 m away, with a random azimuth.
format::Pose tracker_pose(Random random) {
  const double bearing = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double turn = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double away = random.uniform(3.5, 5.0);
  const Vector3d tilt(0.02 * random.normal(), 0.02 * random.normal(), 0.0);
  const Vector3d p(away * std::cos(bearing), away * std::sin(bearing), random.uniform(-1.4, -0.8));
  return sim::to_pose(Eigen::Translation3d(p) * Eigen::AngleAxisd(turn, Vector3d::UnitZ()) *
                      sim::exp(Vector3d::Zero(), tilt));
}

SimulationPlan plan_of(const BlindRequest& request, const Cell& cell) {
  SimulationPlan plan;
  plan.seed = request.seed;
  plan.poses = request.poses;
  plan.choice = request.choice;
  plan.repeats = request.repeats;
  plan.noise_m = request.sigma_m;
  plan.directions = request.directions;
  plan.temperatures = request.temperatures;
  plan.climate = request.climate;
  plan.held_share = request.held_share;
  plan.outlier_share = request.outlier_share;
  plan.truth.effects = request.effects;
  plan.truth.richness = request.richness;
  plan.truth.seed = request.seed;
  plan.session_s = request.session_s;
  const int rows = request.poses + (request.poses + 9) / 10 * (request.repeats - 1);
  plan.seconds_per_pose = request.session_s / std::max(rows, 1);
  if (is_planar(request.arm)) {
    plan.axes = {true, true, false};
    plan.truth.effects.push_back(request.arm == BlindArm::kPlanarPublished ? "planar_published"
                                                                           : "planar_printed");
    return plan;
  }
  plan.truth.geometry_m = kGeometry_m;
  plan.truth.geometry_rad = kGeometry_rad;
  plan.truth.mass_share = kMassShare;
  plan.truth.X_MB = tracker_pose({request.seed, "upright tracker"});
  if (request.payloads == BlindRequest::Payloads::kVaried) {
    plan.payloads = three_payloads(cell, {request.seed, "payload set"});
  }
  return plan;
}

// The plan for the same arm and session at other poses, measured without noise.
SimulationPlan fresh_plan(const BlindRequest& request, SimulationPlan plan,
                          std::vector<HiddenEffect> effects) {
  plan.truth.effects.clear();
  plan.truth.sized = std::move(effects);
  plan.seed = request.seed ^ 0x5eedf4e54ULL;
  plan.poses = request.fresh_poses;
  plan.repeats = 1;
  plan.noise_m = 0.0;
  plan.outlier_share = plan.held_share = 0.0;
  plan.seconds_per_pose = request.session_s / std::max(request.fresh_poses, 1);
  return plan;
}

std::vector<HiddenEffect> of_the_arm(const std::vector<HiddenEffect>& effects) {
  std::vector<HiddenEffect> out;
  std::copy_if(effects.begin(), effects.end(), std::back_inserter(out), [](const auto& effect) {
    const Domain domain = sim::find_law(effect.name)->domain;
    return domain == Domain::kRobot || domain == Domain::kEnvironment;
  });
  return out;
}

// Measures with the same context columns as `like`, whatever effects act.
Simulation measured_again(const Cell& cell, SimulationPlan plan, const Simulation& like) {
  const auto has = [&](const std::string& name) {
    return std::any_of(like.context.begin(), like.context.end(),
                       [&](const Column& column) { return column.name == name; });
  };
  plan.directions = has("dir_j1") ? Recorded::kAlways : Recorded::kNever;
  plan.temperatures = has("temp") ? Recorded::kAlways : Recorded::kNever;
  return simulate(cell, plan);
}

}  // namespace

BlindCase make_blind_case(const BlindRequest& request) {
  BlindCase out;
  out.cell = cell_of(request);
  out.cell.measurement.sigma_m = request.sigma_m;
  out.cell.measurement.files = {"measurements.csv"};
  const SimulationPlan plan = plan_of(request, out.cell);
  out.measured = simulate(out.cell, plan);
  out.fresh =
      measured_again(out.cell, fresh_plan(request, plan, out.measured.effects), out.measured);
  out.fresh_robot = measured_again(
      out.cell, fresh_plan(request, plan, of_the_arm(out.measured.effects)), out.measured);
  out.cell_toml = write_cell(out.cell);
  out.measurements_csv = simulated_csv(out.cell, out.measured);
  out.fresh_csv = simulated_csv(out.cell, out.fresh);
  out.fresh_robot_csv = simulated_csv(out.cell, out.fresh_robot);
  out.truth_json = out.measured.truth_json;
  return out;
}

}  // namespace plumb::offline
