// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulate/law.hpp"
#include "simulate/simulation.hpp"
#include "simulate/simulation_plan.hpp"

namespace plumb::offline::sim {

/// A hidden effect and the law that was made from it.
struct HiddenLaw {
  std::string name;
  std::unique_ptr<Law> law;
};

/// The nominal chain with an error drawn for every length (sigma geometry_m) and every angle
/// (geometry_rad): theta, d, a, alpha of each row; between near-parallel axes Hayati's beta in
/// place of d. An arm that is like another one shares 0.8 of the errors of that one.
format::Chain draw_geometry(const Cell& cell, const HiddenTruth& truth, Random random);

/// The whole truth as a JSON text with keys in a fixed order: parameters with units, frame, target,
/// effects, noise, and the point of each row without noise.
std::string truth_json(const Cell& cell, const SimulationPlan& plan, const Simulation& simulation,
                       const std::vector<HiddenLaw>& laws);

}  // namespace plumb::offline::sim
