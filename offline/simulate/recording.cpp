// SPDX-License-Identifier: Apache-2.0
#include "simulate/recording.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "cell/contexts.hpp"

namespace plumb::offline {
namespace sim {
namespace {

constexpr int kEveryTenth = 10;
constexpr double kLeastOutlier = 30.0, kMostOutlier = 300.0;  // [sigma]
constexpr double kOutlierUnit_m = 10e-6;  // unit of outliers if the plan has no noise
// The name of a pose: P001, P002, ... with as many digits as the last one needs, at least three.
std::string pose_name(int pose, int poses) {
  const std::size_t digits = std::max<std::size_t>(std::to_string(poses).size(), 3);
  const std::string number = std::to_string(pose + 1);
  return "P" + std::string(digits - number.size(), '0') + number;
}

// The readings of every pose, in the order in which they are taken.
std::vector<int> poses_of_rows(const SimulationPlan& plan, int distinct) {
  std::vector<int> out;
  for (int pose = 0; pose < distinct; ++pose) {
    const int times = pose % kEveryTenth == 0 ? plan.repeats : 1;
    out.insert(out.end(), times, pose);
  }
  for (int k = 0; k < plan.revisits; ++k) {
    out.push_back(static_cast<int>(static_cast<long>(k) * distinct / plan.revisits));
  }
  return out;
}

// Marks random poses as held out. All readings of a pose have the same mark.
std::vector<SetMark> marks(const SimulationPlan& plan, const std::vector<int>& pose_of_row) {
  std::vector<SetMark> out(pose_of_row.size(), SetMark::kUnmarked);
  if (plan.held_share == 0.0) return out;
  Random random(plan.seed, "held-out");
  const auto first = first_readings(pose_of_row);
  for (std::size_t row = 0; row < out.size(); ++row) {
    if (first[row] < row) {
      out[row] = out[first[row]];
    } else {
      out[row] = random.uniform() < plan.held_share ? SetMark::kHeld : SetMark::kFit;
    }
  }
  return out;
}

}  // namespace

std::vector<std::size_t> first_readings(const std::vector<int>& pose_of_row) {
  std::map<int, std::size_t> first;
  std::vector<std::size_t> out;
  for (std::size_t row = 0; row < pose_of_row.size(); ++row) {
    out.push_back(first.emplace(pose_of_row[row], row).first->second);
  }
  return out;
}

Recording::Recording(const Cell& cell, const SimulationPlan& plan, const RowsN& poses,
                     const std::vector<HiddenEffect>& effects)
    : cell_(cell), plan_(plan), effects_(effects), noise_(plan.seed, "noise") {
  const int distinct = static_cast<int>(poses.rows());
  measured_.replicate_group = poses_of_rows(plan, distinct);
  const int rows = static_cast<int>(measured_.replicate_group.size());
  measured_.q.resize(rows, poses.cols());
  for (int row = 0; row < rows; ++row) {
    const int pose = measured_.replicate_group[row];
    measured_.pose.push_back(pose_name(pose, distinct));
    measured_.q.row(row) = poses.row(pose);
  }
  measured_.set = marks(plan, measured_.replicate_group);
  measured_.p_M = Rows3::Zero(rows, 3);
  measured_.has_axis = plan.axes;
  if (plan.noise_rad) measured_.quat_M.resize(rows, 4);
}

void Recording::measure(int row, const Isometry3d& X_MG) {
  for (int k = 0; k < 3; ++k) {
    const double error = plan_.noise_m * noise_.normal();
    if (plan_.axes[k]) measured_.p_M(row, k) = X_MG.translation()(k) + error;
  }
  if (!plan_.noise_rad) return;
  Vector3d turn;
  for (int k = 0; k < 3; ++k) turn(k) = *plan_.noise_rad * noise_.normal();
  const auto pose = to_pose(exp(Vector3d::Zero(), turn) * Isometry3d(X_MG.rotation()));
  for (int k = 0; k < 4; ++k) measured_.quat_M(row, k) = pose.q[k];
}

std::vector<GrossOutlier> Recording::spoil() {
  Random random(plan_.seed, "outliers");
  const double unit = plan_.noise_m > 0.0 ? plan_.noise_m : kOutlierUnit_m;
  std::vector<int> left(static_cast<std::size_t>(rows()));
  std::iota(left.begin(), left.end(), 0);
  std::vector<GrossOutlier> out;
  const long count = std::lround(plan_.outlier_share * rows());
  for (long k = 0; k < count; ++k) {
    const int at = random.below(static_cast<int>(left.size()));
    const Vector3d shift = unit * random.uniform(kLeastOutlier, kMostOutlier) * random.direction();
    out.push_back({left[static_cast<std::size_t>(at)], {shift.x(), shift.y(), shift.z()}});
    left.erase(left.begin() + at);
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
  for (const auto& outlier : out) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (plan_.axes[k]) measured_.p_M(outlier.row, static_cast<int>(k)) += outlier.shift_M[k];
    }
  }
  return out;
}

MeasurementFiles Recording::finish(const std::vector<Column>& context) const {
  MeasurementFiles out{measured_, {}};
  if (const double step = plan_.imperfections.encoder_step; step > 0.0) {
    out.q = step * (out.q / step).array().round() + 0.0;  // + 0: no minus zero
  }
  Table table;
  table.file = "simulated";
  table.columns = context;
  for (int row = 0; row < rows(); ++row) table.lines.push_back(row + 2);
  table.raw_rows.resize(rows());
  out.tables.push_back(std::move(table));
  out.file = file_of_rows(out.tables);
  out.context = read_contexts(out.tables, out.q);
  return out;
}

}  // namespace sim

std::string simulated_csv(const Cell& cell, const Simulation& simulation) {
  return write_measurements(simulation.measured, cell.nominal,
                            {{"instrument", "simulated laser tracker"}, {"robot", cell.robot_name}},
                            simulation.context);
}

}  // namespace plumb::offline
