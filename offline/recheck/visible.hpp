// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "recheck/evidence.hpp"

namespace plumb::offline::recheck {

/// How well some readings would show a change.
struct Visibility {
  Change change;
  /// RMS motion [m] of the measured point over the poses of the calibration that the change may
  /// have without being noticed, in the direction in which it is seen worst.
  double unseen_m = 0.0;
};

/// The visibility of every change but those of single readings. `S`: as in Judged, with nothing
/// changed; `own`: the poses over which motions are averaged.
std::vector<Visibility> visibility(const std::vector<Change>& changes, const Measurements& rows,
                                   const Measurements& own, const ArmState& state,
                                   const Eigen::MatrixXd& S);

}  // namespace plumb::offline::recheck
