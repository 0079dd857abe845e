// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "compile/refusal_share.hpp"
#include "compile/tool_uncertainty.hpp"
#include "compile/trained_poses.hpp"
#include "plumb/format/model.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// What a person should know before a model moves a robot. SI.
struct Audit {
  double worst_correction_m = 0.0;  // largest distance of the calibrated tool from the nominal one
  double worst_rotation_rad = 0.0;
  std::vector<double> worst_q;  // the joint positions there [rad] or [m]
  double worst_jump_m = 0.0;    // largest step of a tree at a leaf border, one axis; blended: 0
  ToolUncertainty tool;
  int leaves = 0;
  int active_leaves = 0;  // largest number of leaves with a weight at one point, one axis
  std::size_t bytes = 0;
  RefusalShare refusals;         // in the trained range, and between the joint limits
  std::vector<Problem> remarks;  // a correction above the guard's limit, and such
};

/// Looks at kAuditPoses (trained_poses.hpp) random poses of the trained domain, the same ones every
/// time.
Audit audit(const format::Model& model);

}  // namespace plumb::offline
