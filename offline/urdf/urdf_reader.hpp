// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cell/cell.hpp"

namespace plumb::offline {

/// Reads the arm of a URDF file from its root to the link `tip` (if empty, to its only leaf) and
/// converts it to DH rows of the convention. Fixed joints are merged, limits and inertias are taken
/// over, and base and tool are chosen so that the forward kinematics equal those of the file.
/// Throws Failure (kInput): E-URDF, E-URDF-TIP, E-URDF-JOINT.
Cell read_urdf(const std::filesystem::path& file, const std::string& tip,
               format::Convention convention);

}  // namespace plumb::offline
