// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "compile/refusal_share.hpp"
#include "plumb/format/model.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// What a person should know before a model moves a robot. SI.
struct Audit {
  double worst_correction_m = 0.0;  // largest distance of the calibrated tool from the nominal one
  double worst_rotation_rad = 0.0;
  std::vector<double> worst_q;     // the joint positions there [rad] or [m]
  double worst_jump_m = 0.0;       // largest step of a tree at a leaf border, one axis; blended: 0
  double sigma_tool_mean_m = 0.0;  // predicted 1 sigma of the tool point (3-D), from the covariance
  double sigma_tool_max_m = 0.0;
  int leaves = 0;
  int active_leaves = 0;  // largest number of leaves with a weight at one point, one axis
  std::size_t bytes = 0;
  RefusalShare refusals;         // in the trained range, and between the joint limits
  std::vector<Problem> remarks;  // a correction above the guard's limit, and such
};

inline constexpr int kAuditPoses = 2000;

/// Looks at kAuditPoses random poses of the trained domain, the same ones every time.
Audit audit(const format::Model& model);

}  // namespace plumb::offline
