// SPDX-License-Identifier: Apache-2.0
#include "cell/arm_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cell/artefacts.hpp"
#include "cell/column_names.hpp"
#include "cell/context_columns.hpp"
#include "cell/rotation.hpp"
#include "cell/table_place.hpp"

namespace plumb::offline {
namespace {

constexpr double kQuaternionSlack = 1e-3;

AxisColumns find_axes(const Table& table, const std::string& prefix) {
  return {table.find(prefix + "x"), table.find(prefix + "y"), table.find(prefix + "z")};
}

int count(const auto& columns) {
  return static_cast<int>(
      std::count_if(columns.begin(), columns.end(), [](const Column* c) { return c != nullptr; }));
}

const Column* first_of(const auto& columns) {
  for (const Column* column : columns)
    if (column != nullptr) return column;
  return nullptr;
}

/// Columns that go with the measured axes: one for each of them, or none at all.
AxisColumns find_companions(const Table& table, const std::string& prefix, const char* unit,
                            const AxisColumns& p, ProblemList& problems) {
  const AxisColumns out = find_axes(table, prefix);
  const Column* given = first_of(out);
  if (given == nullptr) return out;
  for (int k = 0; k < 3; ++k)
    if (p[k] != nullptr && out[k] == nullptr)
      problems.error("E-CSV-AXIS",
                     fmt::format("column '{}{}_{}' is missing: '{}' is given", prefix, "xyz"[k],
                                 unit, given -> header),
                     place_in_header(table, *given, "not for every measured axis"),
                     fmt::format("give one for each measured axis, or delete '{}'", given->header));
  return out;
}

void check_sigma(const Table& table, const AxisColumns& sigma, ProblemList& problems) {
  for (const Column* column : sigma)
    for (int row = 0; column != nullptr && row < table.rows() && !problems.full(); ++row)
      if (column->values[row] < 0.0)
        problems.error(
            "E-CSV-SIGMA",
            fmt::format("column '{}': a standard deviation cannot be negative", column->header),
            place_in_row(table, row, *column, "negative"),
            "give the reading's 1 sigma, or delete the three columns");
}

void incomplete(const Table& table, const char* what, const auto& columns, ProblemList& problems) {
  problems.error("E-CSV-ORIENTATION", fmt::format("the orientation needs all of {}", what),
                 place_in_header(table, *first_of(columns), "the others are missing"),
                 "complete the columns, or delete these");
}

void too_many_joints(const Table& table, const std::string& prefix, int joints,
                     ProblemList& problems) {
  for (const auto& column : table.columns)
    if (joint_number(column.name, prefix) > joints)
      problems.error("E-CSV-JOINT",
                     fmt::format("column '{}', but the arm has {} joints", column.header, joints),
                     place_in_header(table, column, "no such joint"),
                     "delete the column, or complete [robot] joints in cell.toml");
}

}  // namespace

std::optional<EulerConvention> stated_rotation(const Table& table) {
  std::optional<EulerConvention> out;
  for (const auto& [key, value] : table.comments)
    if (key == "rot" && !out) out = find_euler_convention(value);
  return out;
}

std::vector<const Column*> find_joints(const Table& table, const std::string& prefix,
                                       const std::vector<bool>& joint_is_angle,
                                       ProblemList& problems) {
  std::vector<const Column*> out;
  for (std::size_t i = 0; i < joint_is_angle.size(); ++i) {
    const bool turns = joint_is_angle[i];
    const std::string wanted = fmt::format("{}{}_{}", prefix, i + 1, turns ? "deg" : "mm");
    const Column* column = table.find(fmt::format("{}{}", prefix, i + 1));
    out.push_back(column);
    if (column == nullptr)
      problems.error(
          "E-CSV-JOINT", fmt::format("no column for joint {}", i + 1),
          place_of_missing(table, fmt::format("'{}' is missing", wanted)),
          fmt::format("add the column '{}': the arm has {} joints", wanted, joint_is_angle.size()));
    else if (column->quantity != (turns ? Quantity::kAngle : Quantity::kLength))
      problems.error("E-CSV-KIND",
                     fmt::format("column '{}' is {}, but joint {} {}", column->header,
                                 kind_name(column->quantity), i + 1, turns ? "turns" : "slides"),
                     place_in_header(table, *column, "wrong kind of unit"),
                     fmt::format("rename it to '{}' if the numbers are, or correct the joint's "
                                 "type in cell.toml",
                                 wanted));
  }
  too_many_joints(table, prefix, static_cast<int>(joint_is_angle.size()), problems);
  return out;
}

void find_orientation(const Table& table, ArmColumns& out, ProblemList& problems) {
  out.quat = {table.find("qw"), table.find("qx"), table.find("qy"), table.find("qz")};
  out.turns = find_axes(table, "r");
  const int quat = count(out.quat), turns = count(out.turns);
  if (quat != 0 && quat != 4) incomplete(table, "qw, qx, qy, qz", out.quat, problems);
  if (turns != 0 && turns != 3) incomplete(table, "rx, ry, rz", out.turns, problems);
  if (turns == 0) return;
  const Column& first = *first_of(out.turns);
  if (quat != 0)
    problems.error("E-CSV-ORIENTATION", "the orientation is given twice",
                   place_in_header(table, first, "besides the quaternion"),
                   "delete rx, ry, rz or qw, qx, qy, qz");
  else if (const auto rotation = stated_rotation(table))
    out.rotation = *rotation;
  else
    problems.error("E-CSV-ROTATION", "nothing says in which order rx, ry, rz turn",
                   place_in_header(table, first, "which convention?"),
                   "add the line '# rot: xyz-fixed' if R = Rz Ry Rx, '# rot: rotation-vector', "
                   "..., or give qw, qx, qy, qz");
}

ArmColumns find_arm_columns(const Table& table, const std::vector<bool>& joint_is_angle,
                            Needs needs, ProblemList& problems) {
  ArmColumns out;
  out.q = find_joints(table, "q", joint_is_angle, problems);
  out.p = find_axes(table, "");
  if (needs == Needs::kJointsAndPosition && count(out.p) == 0 && !reads_artefact(table))
    problems.error("E-CSV-POSITION", "no measured position",
                   place_of_missing(table, "'x_mm', 'y_mm', 'z_mm' are missing"),
                   "rename the tracker's columns to x_mm, y_mm, z_mm; where the tool touches "
                   "fixed points, name these in a column 'point'");
  find_orientation(table, out, problems);
  out.sigma = find_companions(table, "s", "um", out.p, problems);
  out.nominal = find_companions(table, "n", "mm", out.p, problems);
  check_sigma(table, out.sigma, problems);
  check_context_columns(table, joint_is_angle, problems);
  out.pose = table.find("pose");
  out.set = table.find("set");
  return out;
}

std::array<double, 4> orientation(const Table& table, const ArmColumns& columns, int row,
                                  ProblemList& problems) {
  if (columns.turns[0] != nullptr) {
    const std::array<double, 3> turns{columns.turns[0]->values[row], columns.turns[1]->values[row],
                                      columns.turns[2]->values[row]};
    return columns.rotation == EulerConvention{} ? quaternion_from_rpy(turns)
                                                 : quaternion(columns.rotation, turns);
  }
  std::array<double, 4> q{};
  for (int k = 0; k < 4; ++k) q[k] = columns.quat[k]->values[row];
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (std::abs(norm - 1.0) > kQuaternionSlack)
    problems.error("E-CSV-QUATERNION", fmt::format("the quaternion has length {:.6g}, not 1", norm),
                   place_in_row(table, row, *columns.quat[0], "qw"),
                   "check the order qw, qx, qy, qz and the decimals");
  else
    for (double& x : q) x /= norm;
  return q;
}

}  // namespace plumb::offline
