// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "program/outcome.hpp"
#include "simulate/simulate.hpp"

namespace plumb::offline::twin {

/// The hidden properties of the twin's arm and the noise of its tracker, read from `twin.toml`
/// beside `cell.toml`, or from `truth.json` of a cell of plumb demo. No other program of Plumb
/// reads these files.
struct Hidden {
  std::uint64_t seed = 1;                 // for arm, poses and noise
  std::vector<std::string> effects = {};  // as for plumb simulate: "joint_compliance:J2=150urad"
  double geometry_m = 0.3e-3;             // 1 sigma of every length error
  double geometry_rad = 0.3e-3;           // and of every angle error
  double noise_m = 10e-6;                 // of the tracker, 1 sigma per axis
  std::array<bool, 3> axes{true, true, true};  // that it measures
  /// Temperatures that the controller reports, in the order of the bus.
  std::vector<std::string> sensors = {"temp", "temp_room", "temp_elbow"};
};

std::string write_hidden(const Hidden& hidden);

/// What truth.json of `plumb demo` and `plumb simulate` says of the arm that they measured.
/// Throws Failure (kInput) if it does not say how the arm can be simulated again.
Hidden hidden_of_truth(std::string text, const std::string& file_name);

/// Reads twin.toml. Throws Failure (kInput) with all problems, including unknown keys.
Hidden parse_hidden(std::string text, const std::string& file_name);

/// The content of a twin's folder: the cell as its user knows it, and what is hidden from the user.
struct TwinFolder {
  Cell cell;
  Hidden hidden;
};
TwinFolder open_folder(const std::filesystem::path& folder, Outcome& outcome);

/// The truth of the arm, the same at every call, with the places of tracker and reflector. Sizes
/// stated in sigma become those that 150 poses of the cell make visible.
/// `like`: the seed of an arm of the same batch.
HiddenTruth truth_of(const Cell& cell, const Hidden& hidden,
                     std::optional<std::uint64_t> like = std::nullopt);

}  // namespace plumb::offline::twin
