// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cell/cell.hpp"

namespace plumb::offline {

/// The arm of a URDF file from its root to `tip` (empty: its only leaf) as DH rows of the
/// convention: fixed joints folded, limits and inertials taken over, base and tool so that forward
/// kinematics are the file's. Throws Failure (kInput): E-URDF, E-URDF-TIP, E-URDF-JOINT.
Cell read_urdf(const std::filesystem::path& file, const std::string& tip,
               format::Convention convention);

}  // namespace plumb::offline
