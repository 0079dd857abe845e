// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cell/cell.hpp"
#include "simulate/simulation.hpp"
#include "simulate/simulation_plan.hpp"

namespace plumb::offline {

/// Measures a simulated arm. Laws and kinematics are independent of the runtime, so that the two
/// can be tested against each other. The same plan gives the same numbers.
/// Throws Failure (kUsage) for an impossible plan or an unknown effect.
Simulation simulate(const Cell& cell, const SimulationPlan& plan);

/// The measurements as a canonical CSV file, context columns included.
std::string simulated_csv(const Cell& cell, const Simulation& simulation);

/// The sample cells of `plumb demo`: the name and one line of description. The first is the
/// default.
const std::vector<std::pair<std::string, std::string>>& demo_cells();
struct Demo {
  Cell cell;
  SimulationPlan plan;
};

/// Makes a sample cell. An empty name gives the default. Throws Failure (kUsage) for an unknown
/// name.
Demo make_demo(const std::string& name);

}  // namespace plumb::offline
