// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "import/raw_rows.hpp"

namespace plumb::offline {

/// The names of the columns of rows that ros2 topic echo --csv writes of sensor_msgs/JointState:
/// seconds, nanoseconds, frame, names, positions, velocities, efforts. Nothing for other rows.
std::optional<std::vector<std::string>> joint_state_header(const CellTable& rows);

/// Columns field.name0, ... name the columns field.position0, ...: these get the joints' names, in
/// rad as ROS writes them (N-IMPORT-STATES).
void name_joint_states(const SourceText& text, RawRows& rows);

}  // namespace plumb::offline
