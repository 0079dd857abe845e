// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/fit.hpp"

namespace plumb::offline::show {

/// A pose and how far the model misses it. SI, measurement frame; measured - predicted.
struct PoseError {
  int row = 0;
  std::string pose;
  Eigen::RowVector3d error_M = Eigen::RowVector3d::Zero();
  bool held = false;
};

/// Mean error of the poses between `from` and `to` of some quantity; SI, or rows of the file.
struct ErrorBin {
  double from = 0.0;
  double to = 0.0;
  int n = 0;
  double mean_m = 0.0;  // 0 if n == 0
};

/// How the error depends on one quantity.
struct ErrorProfile {
  enum class Kind { kJoint, kRegion, kOrder } kind = Kind::kJoint;
  std::string name;  // joint, or "reach", "height", "azimuth", or "order"
  enum class Unit { kLength, kAngle, kRow } unit = Unit::kAngle;
  std::vector<ErrorBin> bins;

  /// Highest over lowest bin mean; 1 if fewer than two bins are filled.
  double contrast() const;
};

/// Model against measurements on the held-out poses, or on all if none was held out.
struct Comparison {
  enum class Set { kHeldOut, kFit } set = Set::kHeldOut;
  ErrorStats stats;
  double within_tolerance = 0.0;  // share, 0 .. 1
  std::vector<PoseError> poses;   // of that set, worst first
  std::vector<ErrorProfile> profiles;
};

/// `fit` must be of these measurements. Cost: poses log poses.
Comparison compare(const Cell& cell, const Measurements& measured, const Fit& fit);

}  // namespace plumb::offline::show
