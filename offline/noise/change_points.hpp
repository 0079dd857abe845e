// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "noise/step_motions.hpp"

namespace plumb::offline {

/// A moment at which the mean residual jumps. SI; rows of the measurements.
struct StepFound {
  MotionSource source = MotionSource::kTool;  // what would have to have moved
  int joint = -1;
  int before = 0, after = 0;     // last row before it, first one behind
  int earliest = 0, latest = 0;  // the last row before it lies between these with 95 %
  Eigen::VectorXd shift;         // as StepMotions::columns: 3 [m], 6 [m, rad], 1 [rad] or [m]
  double size_m = 0.0;           // RMS motion of the measured point
  double ln_p = 0.0;             // ln of its probability by chance, corrected for all cuts tried
};

/// A smooth change in the order of measuring that explains more than a jump.
struct DriftFound {
  MotionSource source = MotionSource::kTool;
  int joint = -1;
  int from = 0, to = 0;  // rows
  double size_m = 0.0;   // RMS motion of the measured point from the start to the end
  double ln_p = 0.0;     // ln of its probability by chance
};

struct Changes {
  int visits = 0;                // 0: too few to look
  std::vector<StepFound> steps;  // in order
  std::vector<DriftFound> drifts;
};

/// Binary segmentation [Scott & Knott 1974]: takes the most significant cut if its probability by
/// chance is below 1 % over all cuts and motion sources (Bonferroni), then searches either side in
/// the same way. The two sides of a cut have separate shifts of the tool, the base or a joint. The
/// F statistic is divided by the factor by which unequal variances and autocorrelation of the
/// residuals inflate the variance of the jump. Where a drift that is linear and quadratic in the
/// order is more significant than the cut, the drift is removed instead: it is no series of jumps.
Changes change_points(const StepMotions& motions);

}  // namespace plumb::offline
