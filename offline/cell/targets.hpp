// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Desired tool poses in the base frame, with the joint state to start from. SI; row i of each.
struct Targets {
  Rows3 p_B;               // [m]
  Rows4 quat_B;            // (w, x, y, z), or 0 rows: the nominal orientation at the seed is meant
  RowsN seed;              // joint angles [rad] or travels [m], or 0 rows
  bool commanded = false;  // the seed comes from columns qc1 …, what the controller was told
  ContextRows context;     // direction, payload, temperatures
  Table table;
};

/// Columns x_mm, y_mm, z_mm, qw, qx, qy, qz and q1_deg … or qc1_deg …; throws Failure (kInput).
Targets read_targets(const std::filesystem::path& file, const JointColumns& joints);

/// The same of a table that was read already, or of a part of one.
Targets targets_of(Table table, const JointColumns& joints);

}  // namespace plumb::offline
