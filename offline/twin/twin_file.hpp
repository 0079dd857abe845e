// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "program/outcome.hpp"
#include "simulate/simulate.hpp"

namespace plumb::offline::twin {

/// What the twin's arm hides and how well its tracker reads; `twin.toml` beside `cell.toml`. No
/// other program of ours reads it.
struct Hidden {
  std::uint64_t seed = 1;                 // of arm, poses and noise
  std::vector<std::string> effects = {};  // as for plumb simulate: "joint_compliance:J2=150urad"
  double geometry_m = 0.3e-3;             // 1 sigma of every length error
  double geometry_rad = 0.3e-3;           // and of every angle error
  double noise_m = 10e-6;                 // of the tracker, 1 sigma per axis
  /// Temperatures that the controller reports, in the order of the bus.
  std::vector<std::string> sensors = {"temp", "temp_room", "temp_elbow"};
};

std::string write_hidden(const Hidden& hidden);

/// Throws Failure (kInput) with all problems, unknown keys included.
Hidden parse_hidden(std::string text, const std::string& file_name);

/// What stands in a twin's folder: the cell as its user knows it, and what is hidden from them.
struct TwinFolder {
  Cell cell;
  Hidden hidden;
};
TwinFolder open_folder(const std::filesystem::path& folder, Outcome& outcome);

/// The same arm every time: sizes in sigma become those that 150 poses of the cell make visible.
HiddenTruth truth_of(const Cell& cell, const Hidden& hidden);

}  // namespace plumb::offline::twin
