// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// How far from the measured point its orientation is told as a distance [m].
inline constexpr double kBeside_m = 0.1;

/// How well a model knows where the tool is, by the covariance of its fitted numbers: 1 sigma in
/// space over kAuditPoses poses of the trained domain [m]. All 0 for a model without a covariance.
struct ToolUncertainty {
  double mean_m = 0.0, max_m = 0.0;  // of the tool point
  /// What the uncertain orientation of the tool adds, on average, to a point kBeside_m from there.
  /// Angles of the last link that no position shows count with what arms are built to, 0.5 mrad;
  /// `turn_unmeasured` says that there are such.
  double beside_m = 0.0;
  bool turn_unmeasured = false;
};

/// Cost: 2000 evaluations of the chain and its derivatives.
ToolUncertainty tool_uncertainty(const format::Model& model);

}  // namespace plumb::offline
