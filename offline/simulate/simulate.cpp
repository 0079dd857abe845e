// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulate.hpp"

#include <cmath>

#include "simulate/recording.hpp"
#include "simulate/truth.hpp"

namespace plumb::offline {
namespace {

using sim::HiddenLaw;
using sim::Isometry3d;
using sim::Random;
using sim::Vector3d;
using sim::VectorXd;
using sim::Visit;

void check(const Cell& cell, const SimulationPlan& plan) {
  const auto refuse = [](const std::string& message, const std::string& help) {
    throw Failure(Exit::kUsage, {Severity::kError, "E-SIM-PLAN", message, std::nullopt, help});
  };
  const auto sigma = [](double s) { return std::isfinite(s) && s >= 0.0; };
  if (plan.q.rows() == 0 && plan.poses < 1) refuse("no poses to measure", "ask for at least one");
  if (plan.q.rows() > 0 && plan.q.cols() != cell.joints()) {
    refuse("the poses have " + std::to_string(plan.q.cols()) + " joints, the arm " +
               std::to_string(cell.joints()),
           "give one column per joint");
  }
  if (plan.repeats < 1) refuse("a pose is measured at least once", "use repeats of 1 or more");
  if (!sigma(plan.noise_m) || !sigma(plan.noise_rad.value_or(0.0)) ||
      !sigma(plan.truth.geometry_m) || !sigma(plan.truth.geometry_rad)) {
    refuse("a standard deviation is zero or positive", "use for example 10 um");
  }
  for (const auto& row : cell.nominal.joints) {
    if (plan.q.rows() == 0 && !(row.q_min < row.q_max)) {
      refuse("joint " + row.name + " has no range to move in", "set its limits q = [min, max]");
    }
  }
}

VectorXd limits(const Cell& cell, double format::JointRow::*which) {
  VectorXd q(cell.joints());
  for (int j = 0; j < cell.joints(); ++j) q(j) = cell.nominal.joints[j].*which;
  return q;
}

// Distinct poses: given, or uniform inside the limits.
RowsN distinct_poses(const SimulationPlan& plan, const VectorXd& q_min, const VectorXd& q_max) {
  if (plan.q.rows() > 0) return plan.q;
  Random random(plan.seed, "poses");
  RowsN q(plan.poses, q_min.size());
  for (Eigen::Index row = 0; row < q.rows(); ++row) {
    for (Eigen::Index j = 0; j < q.cols(); ++j) q(row, j) = random.uniform(q_min(j), q_max(j));
  }
  return q;
}

// A tracker 3 to 5 m away, arbitrarily turned.
Isometry3d place_tracker(const Cell& cell, const SimulationPlan& plan, std::uint64_t seed) {
  if (plan.truth.X_MB) return sim::to_isometry(*plan.truth.X_MB);
  if (!cell.measurement.fit_frame) return sim::to_isometry(cell.measurement.X_MB);
  Random random(seed, "tracker");
  const Vector3d p = random.uniform(3.0, 5.0) * random.direction();
  return Eigen::Translation3d(p) * random.orientation() * Isometry3d::Identity();
}

// A reflector 50 to 150 mm beside the tool.
Isometry3d place_target(const Cell& cell, const SimulationPlan& plan, std::uint64_t seed) {
  Random random(seed, "target");
  Isometry3d X_TG = Isometry3d::Identity();
  const Vector3d p = random.uniform(0.05, 0.15) * random.direction();
  if (cell.measurement.fit_target) X_TG = Eigen::Translation3d(p) * random.orientation() * X_TG;
  if (!cell.measurement.fit_target) X_TG.translation() = Vector3d(cell.measurement.target_T.data());
  if (plan.truth.target_T) X_TG.translation() = Vector3d(plan.truth.target_T->data());
  return X_TG;
}

std::vector<HiddenLaw> make_laws(const SimulationPlan& plan, const sim::World& world) {
  std::vector<HiddenLaw> laws;
  for (const auto& spec : plan.truth.effects) {
    const HiddenEffect effect = parse_hidden_effect(spec, world.cell);
    laws.push_back({effect.name, sim::find_law(effect.name)->make(effect, world)});
  }
  return laws;
}

// X_BG of one visit: rigid arm first, then everything that bends it.
Isometry3d true_pose(const sim::World& world, const std::vector<HiddenLaw>& laws, int row,
                     const Isometry3d& X_TG) {
  const VectorXd& q = world.visits[row].q;
  const sim::Frames rigid = world.arm.frames(q);
  const sim::Loads loads(world.masses, rigid);
  sim::Deflection deflection(world.arm.joints());
  for (const auto& hidden : laws) hidden.law->bend(row, rigid, loads, deflection);
  Isometry3d X_BG = world.arm.frames(q, deflection).tool * X_TG;
  X_BG.translation() += deflection.tip_B;
  return X_BG;
}

}  // namespace

Simulation simulate(const Cell& cell, const SimulationPlan& plan) {
  check(cell, plan);
  const std::uint64_t arm_seed = plan.truth.seed.value_or(plan.seed);
  Simulation out;
  out.true_chain = sim::draw_geometry(cell, plan.truth, Random(arm_seed, "geometry"));
  const sim::Arm arm(out.true_chain);
  const auto masses = sim::guess_masses(cell, arm, Random(arm_seed, "masses"));
  const VectorXd q_min = limits(cell, &format::JointRow::q_min);
  const VectorXd q_max = limits(cell, &format::JointRow::q_max);

  const RowsN poses = distinct_poses(plan, q_min, q_max);
  sim::Recording recording(cell, plan, poses);
  const auto visits =
      sim::drive(recording.joint_rows(), 0.5 * (q_min + q_max), plan.seconds_per_pose);
  const sim::World world{cell, arm, masses, visits, q_min, q_max, arm_seed};
  const auto laws = make_laws(plan, world);

  const Isometry3d X_MB = place_tracker(cell, plan, arm_seed);
  const Isometry3d X_TG = place_target(cell, plan, arm_seed);
  out.X_MB = sim::to_pose(X_MB);
  out.X_TG = sim::to_pose(X_TG);
  out.true_p_M.resize(recording.rows(), 3);
  for (int row = 0; row < recording.rows(); ++row) {
    const Isometry3d X_MG = X_MB * true_pose(world, laws, row, X_TG);
    out.true_p_M.row(row) = X_MG.translation().transpose();
    recording.measure(row, X_MG);
  }
  out.context = recording.context(visits);
  out.measured = recording.finish(out.context);
  out.truth_json = sim::truth_json(cell, plan, out, laws);
  return out;
}

}  // namespace plumb::offline
