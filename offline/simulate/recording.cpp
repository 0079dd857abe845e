// SPDX-License-Identifier: Apache-2.0
#include "simulate/recording.hpp"

#include <algorithm>

namespace plumb::offline {
namespace sim {
namespace {

constexpr int kEveryTenth = 10;

// P001, P002 and on: as many digits as the last one needs, at least three.
std::string pose_name(int pose, int poses) {
  const std::size_t digits = std::max<std::size_t>(std::to_string(poses).size(), 3);
  const std::string number = std::to_string(pose + 1);
  return "P" + std::string(digits - number.size(), '0') + number;
}

Column number_column(const std::string& name, const std::string& unit, Quantity quantity) {
  Column column;
  column.header = unit.empty() ? name : name + "_" + unit;
  column.name = name;
  column.unit = unit;
  column.quantity = quantity;
  return column;
}

bool needs_direction(const SimulationPlan& plan, const Cell& cell) {
  if (plan.directions == SimulationPlan::Directions::kRecorded) return true;
  return std::any_of(plan.truth.effects.begin(), plan.truth.effects.end(), [&](const auto& spec) {
    return find_law(parse_hidden_effect(spec, cell).name)->needs_direction;
  });
}

}  // namespace

Recording::Recording(const Cell& cell, const SimulationPlan& plan, const RowsN& poses)
    : cell_(cell), plan_(plan), noise_(plan.seed, "noise") {
  const int distinct = static_cast<int>(poses.rows());
  for (int pose = 0; pose < distinct; ++pose) {
    const int times = pose % kEveryTenth == 0 ? plan.repeats : 1;
    measured_.replicate_group.insert(measured_.replicate_group.end(), times, pose);
  }
  const int rows = static_cast<int>(measured_.replicate_group.size());
  measured_.q.resize(rows, poses.cols());
  for (int row = 0; row < rows; ++row) {
    const int pose = measured_.replicate_group[row];
    measured_.pose.push_back(pose_name(pose, distinct));
    measured_.q.row(row) = poses.row(pose);
  }
  measured_.set.assign(rows, SetMark::kUnmarked);
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

std::vector<Column> Recording::context(const std::vector<Visit>& visits) const {
  std::vector<Column> columns{number_column("t", "s", Quantity::kTime)};
  for (const auto& visit : visits) columns[0].values.push_back(visit.time_s);
  if (!needs_direction(plan_, cell_)) return columns;
  for (int j = 0; j < cell_.joints(); ++j) {
    const bool slides = cell_.nominal.joints[j].type == format::JointType::kPrismatic;
    const std::string joint = "j" + std::to_string(j + 1);
    columns.push_back(number_column("dir_" + joint, "", Quantity::kNumber));
    for (const auto& visit : visits) columns.back().values.push_back(visit.direction(j));
    columns.push_back(number_column("travel_" + joint, slides ? "mm" : "deg",
                                    slides ? Quantity::kLength : Quantity::kAngle));
    for (const auto& visit : visits) columns.back().values.push_back(visit.travel(j));
  }
  return columns;
}

Measurements Recording::finish(const std::vector<Column>& context) const {
  Measurements out = measured_;
  Table table;
  table.file = "simulated";
  table.columns = context;
  for (int row = 0; row < rows(); ++row) table.lines.push_back(row + 2);
  table.raw_rows.resize(rows());
  out.tables.push_back(std::move(table));
  out.context = read_contexts(out.tables, out.q);
  return out;
}

}  // namespace sim

std::string simulated_csv(const Cell& cell, const Simulation& simulation) {
  std::vector<bool> is_angle;
  for (const auto& row : cell.nominal.joints) {
    is_angle.push_back(row.type == format::JointType::kRevolute);
  }
  return write_measurements(simulation.measured, is_angle,
                            {{"instrument", "simulated laser tracker"}, {"robot", cell.robot_name}},
                            simulation.context);
}

}  // namespace plumb::offline
