// SPDX-License-Identifier: Apache-2.0
#include "fit/cell_data.hpp"

namespace plumb::offline {

std::vector<bool> joint_is_angle(const Cell& cell) {
  std::vector<bool> out;
  for (const auto& row : cell.nominal.joints)
    out.push_back(row.type == format::JointType::kRevolute);
  return out;
}

Measurements read_cell_measurements(const Cell& cell) {
  auto files = cell.measurement.files;
  if (cell.measurement.held_out.kind == HeldOutRule::Kind::kFile)
    files.push_back(cell.measurement.held_out.file);
  return read_measurements(files, joint_is_angle(cell), Needs::kJointsAndPosition);
}

}  // namespace plumb::offline
