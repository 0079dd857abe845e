// SPDX-License-Identifier: Apache-2.0
#include "tests/cases/blind_case.hpp"

#include <algorithm>
#include <cmath>
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

Cell arm_of(BlindArm arm) {
  switch (arm) {
    case BlindArm::kHeavy:
      return sim::heavy_arm();
    case BlindArm::kTrack:
      return sim::track_arm();
    case BlindArm::kScara:
      return sim::scara_arm();
    case BlindArm::kPalletiser:
      return sim::palletiser_arm();
    default:
      return sim::light_arm();
  }
}

const char* robot_name(BlindArm arm) {
  switch (arm) {
    case BlindArm::kHeavy:
      return "Heavy six-axis arm";
    case BlindArm::kTrack:
      return "Heavy six-axis arm on a track";
    case BlindArm::kScara:
      return "SCARA";
    case BlindArm::kPalletiser:
      return "Palletiser";
    default:
      return "Light six-axis arm";
  }
}

Cell cell_of(const BlindRequest& request) {
  if (request.arm == BlindArm::kPlanarPublished) return planar_cell(PlanarVariant::kPublished);
  if (request.arm == BlindArm::kPlanarPrinted) return planar_cell(PlanarVariant::kPrinted);
  const bool light = request.arm == BlindArm::kLight || request.arm == BlindArm::kScara;
  Cell cell = arm_of(request.arm);
  cell.name = "Blind case " + std::to_string(request.seed);
  cell.serial = "BLIND-" + std::to_string(request.seed);
  cell.robot_name = robot_name(request.arm);
  sim::state_masses(cell, light ? 26.0 : 420.0);
  cell.payload.mass_kg = light ? 6.0 : 60.0;
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

// The cell as it is written: the simulator's centres of mass are behind d of each joint.
Cell stated(Cell cell, StatedMasses masses) {
  const sim::Arm arm(cell.nominal);
  for (int i = 0; i < cell.joints() && masses != StatedMasses::kBehindD; ++i) {
    auto& link = cell.mechanics[static_cast<std::size_t>(i)];
    if (masses == StatedMasses::kNone) link.link_mass_kg.reset();
    if (masses == StatedMasses::kNone) link.link_com_m.reset();
    if (!link.link_com_m) continue;
    const auto& row = cell.nominal.joints[static_cast<std::size_t>(i)];
    Vector3d com(link.link_com_m->data());
    if (masses == StatedMasses::kRight) {
      com.z() += row.d;
    } else if (cell.nominal.convention == format::Convention::kStandard) {
      const auto link_end =
          Eigen::Translation3d(row.a, 0.0, 0.0) * Eigen::AngleAxisd(row.alpha, Vector3d::UnitX());
      com = link_end.inverse() * com;
    }
    link.link_com_m = {com.x(), com.y(), com.z()};
  }
  return cell;
}

// Poses of a palletiser, whose flange is always level.
RowsN level_poses(const Cell& cell, int poses, Random random) {
  RowsN q(poses, cell.joints());
  for (Eigen::Index row = 0; row < q.rows(); ++row) {
    for (Eigen::Index j = 0; j < q.cols(); ++j) {
      const auto& limits = cell.nominal.joints[static_cast<std::size_t>(j)];
      q(row, j) = random.uniform(limits.q_min, limits.q_max);
    }
    q(row, 3) = -(q(row, 1) + q(row, 2));
  }
  return q;
}

void choose_poses(const BlindRequest& request, const Cell& cell, SimulationPlan& plan) {
  if (request.field != PoseField::kAnywhere)
    plan.q = poses_on(request.field, cell, plan.poses, request.seed, plan.seed);
  if (request.arm != BlindArm::kPalletiser) return;
  plan.q = level_poses(cell, plan.poses, {plan.seed, "level poses"});
}

SimulationPlan plan_of(const BlindRequest& request, const Cell& cell) {
  SimulationPlan plan;
  plan.seed = request.seed;
  plan.poses = request.poses;
  plan.choice = request.choice;
  plan.repeats = request.repeats;
  plan.revisits = request.revisits;
  plan.imperfections = request.imperfections;
  plan.noise_m = request.sigma_m;
  if (request.turns) plan.noise_rad = request.turns->times * request.turns->sigma_rad;
  plan.directions = request.directions;
  plan.temperatures = request.temperatures;
  plan.climate = request.climate;
  plan.held_share = request.held_share;
  plan.outlier_share = request.outlier_share;
  plan.truth.effects = request.effects;
  plan.truth.richness = request.richness;
  plan.truth.seed = request.seed;
  plan.session_s = request.session_s;
  const int rows =
      request.poses + (request.poses + 9) / 10 * (request.repeats - 1) + request.revisits;
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
  if (request.arm == BlindArm::kPalletiser) {
    plan.imperfections.coupled.assign(sim::kPalletiserCoupled.begin(),
                                      sim::kPalletiserCoupled.end());
  }
  choose_poses(request, cell, plan);
  return plan;
}

// Effects have the size that poses anywhere show; along a path, geometry imitates most of them.
SimulationPlan along_a_path(const BlindRequest& request, const Cell& cell, SimulationPlan plan) {
  if (request.field == PoseField::kAnywhere) return plan;
  SimulationPlan anywhere = plan;
  anywhere.q.resize(0, 0);
  plan.truth.sized = simulate(cell, anywhere).effects;
  plan.truth.effects.clear();
  return plan;
}

// The plan for the same arm and session at other poses, measured without noise.
SimulationPlan fresh_plan(const BlindRequest& request, const Cell& cell, SimulationPlan plan,
                          std::vector<HiddenEffect> effects) {
  plan.truth.effects.clear();
  plan.truth.sized = std::move(effects);
  plan.seed = request.seed ^ 0x5eedf4e54ULL;
  plan.poses = request.fresh_poses;
  plan.repeats = 1;
  plan.revisits = 0;
  plan.imperfections.joint_scatter.clear();
  plan.imperfections.encoder_step = 0.0;
  plan.noise_m = 0.0;
  plan.noise_rad.reset();
  plan.outlier_share = plan.held_share = 0.0;
  plan.seconds_per_pose = request.session_s / std::max(request.fresh_poses, 1);
  choose_poses(request, cell, plan);
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

// Turns every measured orientation by a smooth function of the place, as a bent lens does.
void turn_by_place(double usual_rad, Random random, Measurements& m) {
  constexpr int kTerms = 6;
  Eigen::Matrix<double, 3, kTerms> by;
  for (double& one : by.reshaped()) one = random.normal();
  const Vector3d middle = m.p_M.colwise().mean().transpose();
  Eigen::Matrix<double, 3, Eigen::Dynamic> turn(3, m.size());
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const Vector3d d = m.p_M.row(i).transpose() - middle;
    Eigen::Matrix<double, kTerms, 1> terms;
    terms << d.x(), d.y(), d.z(), d.x() * d.y(), d.y() * d.z(), std::sin(2.0 * d.x());
    turn.col(i) = by * terms;
  }
  turn *= usual_rad * std::sqrt(static_cast<double>(m.size())) / turn.norm();
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const auto was = m.quat_M.row(i);
    const Eigen::Quaterniond q = Eigen::AngleAxisd(turn.col(i).norm(), turn.col(i).normalized()) *
                                 Eigen::Quaterniond(was(0), was(1), was(2), was(3));
    m.quat_M.row(i) << q.w(), q.x(), q.y(), q.z();
  }
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
  Cell cell = cell_of(request);
  cell.measurement.sigma_m = request.sigma_m;
  if (request.turns) cell.measurement.sigma_rad = request.turns->sigma_rad;
  cell.measurement.files = {"measurements.csv"};
  out.cell = stated(cell, request.masses);
  const SimulationPlan plan = along_a_path(request, cell, plan_of(request, cell));
  out.measured = simulate(cell, plan);
  if (request.turns && request.turns->by_place_rad > 0.0)
    turn_by_place(request.turns->by_place_rad, {request.seed, "orientations by place"},
                  out.measured.measured);
  const auto again = [&](const SimulationPlan& fresh) {
    return measured_again(cell, fresh, out.measured);
  };
  out.fresh = again(fresh_plan(request, cell, plan, out.measured.effects));
  SimulationPlan robot = fresh_plan(request, cell, plan, of_the_arm(out.measured.effects));
  out.fresh_robot = again(robot);
  robot.imperfections = plan.imperfections;
  if (!robot.imperfections.joint_scatter.empty() || robot.imperfections.encoder_step > 0.0) {
    out.fresh_scattered = again(robot);
  }
  out.cell_toml = write_cell(out.cell);
  out.measurements_csv = simulated_csv(out.cell, out.measured);
  out.fresh_csv = simulated_csv(out.cell, out.fresh);
  out.fresh_robot_csv = simulated_csv(out.cell, out.fresh_robot);
  out.truth_json = out.measured.truth_json;
  return out;
}

}  // namespace plumb::offline
