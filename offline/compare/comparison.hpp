// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "compare/autocorrelation.hpp"
#include "compare/joint_shares.hpp"
#include "compare/lack_of_fit.hpp"
#include "compare/profile.hpp"
#include "fit/fit.hpp"
#include "noise/change_points.hpp"

namespace plumb::offline::compare {

/// A pose and its error, measured - predicted, in the measurement frame. SI.
struct PoseError {
  int row = 0;
  std::string pose;
  Eigen::RowVector3d error_M = Eigen::RowVector3d::Zero();
  bool held = false;
};

/// A pose and the error of its orientation [rad].
struct TurnError {
  int row = 0;
  std::string pose;
  double error_rad = 0.0;
};

/// The errors of orientations, where these are fitted: of the set that is judged, worst first, and
/// what they change with.
struct Turns {
  std::vector<TurnError> poses;
  std::vector<ErrorProfile> profiles;
  std::vector<JointShare> joints;  // of the squared turn, about the axis of each
  std::optional<AxisShare> axis;
};

/// Model against measurements: how large the errors are, where, and since when.
struct Comparison {
  enum class Set { kHeldOut, kFit } set = Set::kHeldOut;  // what is judged
  ErrorStats stats;                                       // of that set
  double within_tolerance = 0.0;                          // share of it, 0 .. 1
  double fit_within_tolerance = 0.0;                      // in-sample: never accuracy
  std::vector<PoseError> poses;                           // of that set, worst first
  std::vector<ErrorProfile> profiles;
  Turns turns;                     // empty if orientations are not fitted
  std::vector<JointShare> joints;  // turning joints, in their order
  LackOfFit lack_of_fit;
  Autocorrelation order;
  Changes changes;
};

/// Judges accuracy on the held-out poses, or on all if none was held out; searches for patterns in
/// the errors of all poses in use. `fit` must be of these measurements.
/// Cost: poses log poses; 12,000 poses take less than 0.3 s.
Comparison comparison(const Cell& cell, const Measurements& measured, const Fit& fit);

}  // namespace plumb::offline::compare
