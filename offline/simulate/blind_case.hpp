// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulate/simulate.hpp"

namespace plumb::offline {

/// kHeavy: 2.2 m, 60 kg; kLight: 1.3 m, 10 kg; both with geometry errors and masses that are not as
/// stated. The planar arms of the published study bring their beams with them.
enum class BlindArm { kHeavy, kLight, kPlanarPublished, kPlanarPrinted };

/// What a blind case is made of.
struct BlindRequest {
  BlindArm arm = BlindArm::kHeavy;
  std::vector<std::string> effects;  // as for parse_hidden_effect, such as "gear_ripple:J2:5"
  double sigma_m = 20e-6;            // of the tracker, per axis
  int poses = 150;
  int fresh_poses = 500;
  int repeats = 3;  // of every tenth pose
  std::uint64_t seed = 1;
  double richness = 1.0;  // of the laws, see HiddenTruth
  double outlier_share = 0.0;
  double session_s = 3.0 * 3600.0;
  PoseChoice choice;
  /// kVaried: three payloads, each with a centre of mass of its own; kConstant: the cell's alone.
  enum class Payloads { kVaried, kConstant } payloads = Payloads::kVaried;
  Recorded directions = Recorded::kAlways;
  Recorded temperatures = Recorded::kAlways;
  SimulationPlan::Climate climate = SimulationPlan::Climate::kChanging;
  double held_share = 0.0;
};

/// A measured arm with something hidden. Only the scorer may look at what follows `measured`.
struct BlindCase {
  Cell cell;
  std::string cell_toml;         // refers to measurements.csv
  std::string measurements_csv;  // what a diagnosis may see
  std::string truth_json;
  /// Fresh poses in a session of the same length, at other times of it, noise-free: measured with
  /// everything that acted, and as a perfect measurement would see the arm.
  std::string fresh_csv;
  std::string fresh_robot_csv;
  Simulation measured, fresh, fresh_robot;
};

/// The same request gives the same bytes. Throws Failure (kUsage) as simulate does.
BlindCase make_blind_case(const BlindRequest& request);

}  // namespace plumb::offline
