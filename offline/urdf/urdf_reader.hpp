// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Where the arm begins and ends. Empty: at the root of the file, and at its only leaf.
struct UrdfEnds {
  std::string tip = {}, base = {};
};

/// Reads the arm of a URDF file from the link `base` to the link `tip` and converts it to DH rows
/// of the convention. Fixed joints are merged, limits and inertias are taken over, and base and
/// tool are chosen so that the forward kinematics equal those of the file. Doubts go to `remarks`,
/// if it is given. Throws Failure (kInput): E-URDF, E-URDF-TIP, E-URDF-JOINT.
Cell read_urdf(const std::filesystem::path& file, const UrdfEnds& ends,
               format::Convention convention, std::vector<Problem>* remarks = nullptr);

}  // namespace plumb::offline
