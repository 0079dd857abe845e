// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "cell/table_file.hpp"
#include "fit/calibrate.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {

/// A cell and what was measured of its arm, with the file that it stands in; the rows of all
/// readings.
struct SimulatedArm {
  Cell cell;
  MeasurementFiles measured;
  std::vector<int> rows;
};

/// A plan of so many poses with 20 um of noise, of an arm that is built so far from nominal.
inline SimulationPlan plan_of_arm(std::uint64_t seed, int poses, double geometry = 0.3e-3) {
  SimulationPlan out;
  out.poses = poses;
  out.seed = seed;
  out.noise_m = 20e-6;
  out.truth.geometry_m = out.truth.geometry_rad = geometry;
  return out;
}

/// Six joints that turn.
inline Cell six_joint_cell(std::uint64_t seed) {
  return random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
}

inline SimulatedArm measured_by(Cell cell, const SimulationPlan& plan) {
  const Simulation simulation = simulate(cell, plan);
  MeasurementFiles measured = simulation.measured;
  measured.tables = {parse_table(simulated_csv(cell, simulation), "measurements.csv")};
  std::vector<int> rows(static_cast<std::size_t>(measured.size()));
  std::iota(rows.begin(), rows.end(), 0);
  return {std::move(cell), std::move(measured), std::move(rows)};
}

inline SimulatedArm simulated_arm(std::uint64_t seed, int poses = 100, double geometry = 0.3e-3) {
  return measured_by(six_joint_cell(seed), plan_of_arm(seed, poses, geometry));
}

/// The state that a fit of all rows leaves.
inline ArmState fitted_state(const SimulatedArm& arm) {
  return calibrate(arm.cell, arm.measured, arm.rows).state;
}

inline bool holds(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace plumb::offline
