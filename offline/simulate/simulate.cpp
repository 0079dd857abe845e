// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulate.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/climate.hpp"
#include "simulate/hidden_effect_reader.hpp"
#include "simulate/poses.hpp"
#include "simulate/recording.hpp"
#include "simulate/scatter.hpp"
#include "simulate/session.hpp"

namespace plumb::offline {
namespace {

using sim::Isometry3d;
using sim::Random;
using sim::Vector3d;
using sim::VectorXd;
using sim::Visit;

constexpr int kMostSorted = 20000;  // poses; sorting them to the nearest takes quadratic time

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
  if (plan.revisits < 0 || plan.revisits > (plan.q.rows() > 0 ? plan.q.rows() : plan.poses)) {
    refuse("from none to all poses can be visited again", "use for example 10");
  }
  if (plan.repeats < 1) refuse("a pose is measured at least once", "use repeats of 1 or more");
  if (!sigma(plan.noise_m) || !sigma(plan.noise_rad.value_or(0.0)) ||
      !sigma(plan.truth.geometry_m) || !sigma(plan.truth.geometry_rad)) {
    refuse("a standard deviation is zero or positive", "use for example 10 um");
  }
  const auto share = [](double s) { return s >= 0.0 && s <= 1.0; };
  if (!share(plan.held_share) || !share(plan.outlier_share) || !share(plan.truth.mass_share)) {
    refuse("a share is between 0 and 1", "use for example 2%");
  }
  if (!(plan.truth.richness >= 0.0 && plan.truth.richness <= 3.0)) {
    refuse("the richness of the laws is between 0 and 3", "use 1, or 0 for the plainest laws");
  }
  if (!share(plan.choice.range) || plan.choice.range == 0.0) {
    refuse("the range of the poses is a share of the joint range", "use for example 60%");
  }
  if (plan.choice.grid_levels < 0 || plan.choice.grid_levels == 1) {
    refuse("a grid has at least two levels", "use for example 7, or 0 for no grid");
  }
  if (plan.choice.order == PoseChoice::Order::kNearest && plan.poses > kMostSorted) {
    refuse("too many poses to sort by distance", "ask for at most 20000, or leave them as drawn");
  }
  for (const auto& payload : plan.payloads) {
    if (!sigma(payload.mass_kg)) refuse("a payload is zero or positive", "use for example 2 kg");
  }
  const Imperfections& imperfect = plan.imperfections;
  const std::size_t stated = imperfect.joint_scatter.size();
  if (stated > 1 && stated != static_cast<std::size_t>(cell.joints())) {
    refuse("the scatter of " + std::to_string(stated) + " joints is given, the arm has " +
               std::to_string(cell.joints()),
           "give one value, or one for each joint");
  }
  if (!std::all_of(imperfect.joint_scatter.begin(), imperfect.joint_scatter.end(), sigma) ||
      !sigma(imperfect.encoder_step)) {
    refuse("scatter of joints and step of encoders are zero or positive", "use for example 20");
  }
  for (const double g : imperfect.gravity.value_or(std::array<double, 3>{})) {
    if (!std::isfinite(g)) refuse("the true gravity is not finite", "use for example 0,0,-9.81");
  }
  for (const int joint : imperfect.coupled) {
    const auto& rows = cell.nominal.joints;
    const auto turns = [&](int j) {
      return rows[static_cast<std::size_t>(j)].type == format::JointType::kRevolute;
    };
    if (joint < 1 || joint >= cell.joints() || !turns(joint) || !turns(joint - 1)) {
      refuse("a coupled joint is one that turns behind another that turns",
             "as J3 of a palletiser, which turns behind J2");
    }
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

// The true pose of the base in the tracker frame: that of the plan or of the cell, or else 3 to 5 m
// away with a random orientation.
Isometry3d place_tracker(const Cell& cell, const SimulationPlan& plan, std::uint64_t seed) {
  if (plan.truth.X_MB) return sim::to_isometry(*plan.truth.X_MB);
  if (!cell.measurement.fit_frame) return sim::to_isometry(cell.measurement.X_MB);
  Random random(seed, "tracker");
  const Vector3d p = random.uniform(3.0, 5.0) * random.direction();
  return Eigen::Translation3d(p) * random.orientation() * Isometry3d::Identity();
}

// The position of the reflector: that of the plan or of the cell, or else 50 to 150 mm beside the
// tool.
Isometry3d place_target(const Cell& cell, const SimulationPlan& plan, std::uint64_t seed) {
  Random random(seed, "target");
  Isometry3d X_TG = Isometry3d::Identity();
  const Vector3d p = random.uniform(0.05, 0.15) * random.direction();
  if (cell.measurement.fit_target) X_TG = Eigen::Translation3d(p) * random.orientation() * X_TG;
  if (!cell.measurement.fit_target) X_TG.translation() = Vector3d(cell.measurement.target_T.data());
  if (plan.truth.target_T) X_TG.translation() = Vector3d(plan.truth.target_T->data());
  return X_TG;
}

std::vector<HiddenEffect> hidden_effects(const Cell& cell, const HiddenTruth& truth) {
  if (!truth.sized.empty()) return truth.sized;
  std::vector<HiddenEffect> out;
  for (const auto& spec : truth.effects) out.push_back(parse_hidden_effect(spec, cell));
  return out;
}

const Payload& heaviest(const Cell& cell, const SimulationPlan& plan) {
  const Payload* out = plan.payloads.empty() ? &cell.payload : &plan.payloads.front();
  for (const auto& payload : plan.payloads) {
    if (payload.mass_kg > out->mass_kg) out = &payload;
  }
  return *out;
}

sim::MassModel true_masses(const Cell& cell, const SimulationPlan& plan, const sim::Arm& arm,
                           std::uint64_t seed) {
  auto out = sim::guess_masses(cell, arm, plan.truth.mass_share, Random(seed, "masses"));
  const Payload& payload = heaviest(cell, plan);
  out.payload = payload.mass_kg;
  out.payload_com = Vector3d(payload.com_m.data());
  if (plan.imperfections.gravity) out.gravity = Vector3d(plan.imperfections.gravity->data());
  out.drives = sim::Drives(plan.imperfections.coupled);
  return out;
}

// Assigns one of the payloads to every pose.
void load(std::vector<Visit>& visits, const std::vector<int>& pose_of_row, const Cell& cell,
          const SimulationPlan& plan) {
  const auto first = sim::first_readings(pose_of_row);
  Random random(plan.seed, "payloads");
  for (std::size_t row = 0; row < visits.size(); ++row) {
    const bool same_stop = row > 0 && visits[row].q == visits[row - 1].q;
    if (same_stop) {
      visits[row].payload = visits[row - 1].payload;
    } else if (first[row] < row) {
      visits[row].payload = visits[first[row]].payload;
    } else if (plan.payloads.empty()) {
      visits[row].payload = cell.payload;
    } else {
      const int which = random.below(static_cast<int>(plan.payloads.size()));
      visits[row].payload = plan.payloads[static_cast<std::size_t>(which)];
    }
  }
}

// The visits as the drives make them.
std::vector<Visit> visits_of_drives(const std::vector<Visit>& visits, const sim::Drives& drives,
                                    const VectorXd& start) {
  if (!drives.any_coupled()) return visits;
  RowsN positions(static_cast<Eigen::Index>(visits.size()), start.size());
  for (std::size_t row = 0; row < visits.size(); ++row) {
    positions.row(static_cast<Eigen::Index>(row)) = drives.of_joints(visits[row].q).transpose();
  }
  const auto moves = sim::drive(positions, drives.of_joints(start), 0.0);
  std::vector<Visit> out = visits;
  for (std::size_t row = 0; row < visits.size(); ++row) {
    out[row].q = moves[row].q;
    out[row].direction = moves[row].direction;
    out[row].travel = moves[row].travel;
    out[row].before = moves[row].before;
  }
  return out;
}

void warm(std::vector<Visit>& visits, const SimulationPlan& plan, const sim::Climate& climate) {
  if (plan.climate == SimulationPlan::Climate::kConstant) return;
  for (auto& visit : visits) {
    visit.room_K = climate.air(visit.running_s);
    visit.zone_K = climate.zones(visit.running_s);
  }
}

}  // namespace

Simulation simulate(const Cell& cell, const SimulationPlan& plan) {
  check(cell, plan);
  const std::uint64_t arm_seed = plan.truth.seed.value_or(plan.seed);
  Simulation out;
  out.true_chain = sim::draw_geometry(cell, plan.truth, Random(arm_seed, "geometry"));
  const sim::Arm arm(out.true_chain);
  const auto masses = true_masses(cell, plan, arm, arm_seed);
  const VectorXd q_min = limits(cell, &format::JointRow::q_min);
  const VectorXd q_max = limits(cell, &format::JointRow::q_max);

  const auto effects = hidden_effects(cell, plan.truth);
  sim::Recording recording(cell, plan, sim::distinct_poses(plan, q_min, q_max), effects);
  auto visits = sim::drive(recording.joint_rows(), 0.5 * (q_min + q_max), plan.seconds_per_pose);
  const double session_s = plan.session_s.value_or(recording.rows() * plan.seconds_per_pose);
  load(visits, recording.pose_of_row(), cell, plan);
  sim::put_stated(plan.stated, visits);
  warm(visits, plan,
       sim::Climate(cell.joints(), session_s, plan.truth.richness, Random(arm_seed, "climate")));

  const Isometry3d X_MB = place_tracker(cell, plan, arm_seed);
  const Isometry3d X_TG = place_target(cell, plan, arm_seed);
  const auto driven = visits_of_drives(visits, masses.drives, 0.5 * (q_min + q_max));
  const sim::World world{cell,
                         arm,
                         masses,
                         driven,
                         q_min,
                         q_max,
                         arm_seed,
                         session_s,
                         X_MB,
                         X_TG,
                         masses.payload,
                         plan.truth.richness,
                         sim::draw_scatter(plan, visits)};
  auto hidden = sim::make_laws(effects, world, plan);
  out.effects = std::move(hidden.effects);
  out.sizes = std::move(hidden.sizes);

  out.X_MB = sim::to_pose(X_MB);
  out.X_TG = sim::to_pose(X_TG);
  out.true_p_M.resize(recording.rows(), 3);
  for (int row = 0; row < recording.rows(); ++row) {
    const Isometry3d X_MG = sim::bent_pose(world, hidden.laws, row);
    out.true_p_M.row(row) = X_MG.translation().transpose();
    recording.measure(row, X_MG);
  }
  out.outliers = recording.spoil();
  out.context = recording.context(visits);
  out.measured = recording.finish(out.context);
  out.truth_json = sim::truth_json(cell, plan, out, hidden.laws);
  return out;
}

}  // namespace plumb::offline
