// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// What the simulated arm does that its nominal model does not know. SI.
struct HiddenTruth {
  double geometry_m = 0.0;    // 1 sigma of every length error
  double geometry_rad = 0.0;  // 1 sigma of every angle error
  std::vector<std::string> effects;  // names of the simulator's own laws, "joint_compliance:J2,J3"
  format::Pose X_MB;                 // where the tracker stands
  std::array<double, 3> target_T{};  // where the reflector sits on the tool
};

struct SimulationPlan {
  int poses = 150;
  int repeats = 1;  // of every tenth pose, for the noise floor, if > 1
  double noise_m = 10e-6;
  std::uint64_t seed = 1;
  HiddenTruth truth;
};

struct Simulation {
  Measurements measured;
  Rows3 true_p_M;          // without noise
  std::string truth_json;  // every true parameter, for the scorer only
};

/// Measures a simulated arm. Its laws and its kinematics are its own: nothing of the runtime's
/// effects is used here, so a test against it is a test.
Simulation simulate(const Cell& cell, const SimulationPlan& plan);

/// Effects the simulator knows, one line each for --help.
const std::vector<std::pair<std::string, std::string>>& simulated_effects();

/// Sample cells of `plumb demo`: name and one line about it.
const std::vector<std::pair<std::string, std::string>>& demo_cells();
struct Demo {
  Cell cell;
  SimulationPlan plan;
};
Demo make_demo(const std::string& name);

}  // namespace plumb::offline
