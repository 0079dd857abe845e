// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "fit/run_store.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// What a person should know before a model moves a robot.
struct Audit {
  double worst_correction_m = 0.0;  // largest |T(q) - N(q)| at the tool over the trained domain
  double worst_rotation_rad = 0.0;
  std::vector<double> worst_q;        // where
  double worst_jump_m = 0.0;          // largest step of the tree at a leaf border inside the domain
  double sigma_tool_mean_m = 0.0;     // predicted 1 sigma at the tool point, from the covariance
  double sigma_tool_max_m = 0.0;
  std::size_t bytes = 0;
  std::vector<std::string> left_out;  // fitted, but not compiled, and why
  std::vector<Problem> remarks;       // worst correction above the guard limit, and such
};

/// The model of a run: nominal and calibrated chain, trees, trained domain, guard, provenance.
/// `from_all_poses`: the run was refitted on every pose and carries no held-out figure.
format::Model compile(const Cell& cell, const Run& run);

Audit audit(const format::Model& model);

}  // namespace plumb::offline
