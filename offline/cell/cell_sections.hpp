// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "cell/units.hpp"
#include "program/toml_table.hpp"

namespace plumb::offline {

/// A cell while its file is read. The sections are read in the order below: [robot] sets the units
/// and the joints the others refer to.
struct CellDraft {
  Cell cell;
  Unit length = *unit_of("mm");
  Unit angle = *unit_of("deg");

  int joint_index(const std::string& name) const;  // -1 if there is none
  std::vector<std::string> joint_names() const;
};

void read_robot(TomlTable& robot, CellDraft& draft);
void read_coupling(TomlTable& robot, CellDraft& draft);  // of [robot]
void read_measurement(TomlTable& measurement, CellDraft& draft);
void read_setups(TomlTable& measurement, CellDraft& draft);  // [[measurement.setup]]
void read_effects(TomlTable& effects, CellDraft& draft);
void read_fit(TomlTable& fit, CellDraft& draft);
void read_deploy(TomlTable& deploy, CellDraft& draft);

/// { xyz, rpy } in the file's units; R = Rz(yaw) Ry(pitch) Rx(roll).
format::Pose read_pose(TomlTable& pose, const CellDraft& draft);

/// "J2.d", "J3.post.dx": measured in length, all others in angle.
bool is_length_parameter(const std::string& name);

/// Reports a name that is no joint, with "did you mean".
void unknown_joint(TomlTable& table, const std::string& name, const toml::node& node,
                   const CellDraft& draft);

}  // namespace plumb::offline
