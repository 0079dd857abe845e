// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/output_files.hpp"
#include "simulate/simulate.hpp"

namespace plumb::offline::cli {

/// What `plumb simulate` is asked for, in the units of the command line.
struct SimulateOptions {
  int poses = 150;
  int repeats = 1;
  int revisits = 0;
  double noise_um = 10.0;
  std::optional<double> noise_urad;
  double geometry_mm = 0.3;
  double geometry_mrad = 0.3;
  double richness = 1.0;
  std::uint64_t seed = 1;
  std::vector<std::string> hidden;
  bool directions = false;
  bool temperatures = false;
  bool constant_temperature = false;
  std::vector<double> payloads_kg;
  std::vector<double> joint_scatter_urad;
  double encoder_step_urad = 0.0;
  std::vector<double> true_gravity;
  std::vector<std::string> coupled_drives;
  std::string outliers = "0%", held = "0%", range = "100%", mass_error = "0%";
  std::string order = "drawn";
  int grid = 0;
  double seconds = 30.0;
  int fresh_poses = 500;
  bool list = false;
  std::string output, truth, fresh;
  WriteOptions write;

  void add_to(VerbOptions& verb);

  /// The plan that the options describe. Throws Failure (kUsage) for a text that is no share.
  SimulationPlan plan(const Cell& cell) const;

  /// The same arm and session at other poses, read without noise.
  SimulationPlan fresh_plan(SimulationPlan plan, const Simulation& simulation) const;
};

}  // namespace plumb::offline::cli
