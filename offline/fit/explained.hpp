// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "fit/cut_search.hpp"
#include "fit/motion_sums.hpp"

namespace plumb::offline {

/// What one motion source explains of a segment, by a jump or by a drift, beyond its mean.
struct Explained {
  const MotionSums* sums = nullptr;
  int cut = 0;                    // first visit behind the jump; 0: a drift
  double gain = 0.0, left = 0.0;  // sums of squares
  double inflation = 1.0;   // of their variance ratio: residuals are uneven and remember each other
  double free = 1.0;        // degrees of freedom left
  double ln_p = 0.0;        // chance, every cut and motion source counted
  Eigen::Matrix3Xd fitted;  // shape (3, segment)
};

/// What there is to explain; `sources`: how many are tried.
struct Unexplained {
  const Eigen::Matrix3Xd& error;  // of all visits
  int axes;
  double sources;
};

/// Visits that a side of a cut has at least.
int fewest_visits(const MotionSums& sums);

/// The best cut of the segment; nothing if it is too short. `sums` must be of that error.
std::optional<Explained> jump_of(const MotionSums& sums, const VisitRun& s,
                                 const Unexplained& what);

/// Motion linear and quadratic in order.
std::optional<Explained> drift_of(const MotionSums& sums, const VisitRun& s,
                                  const Unexplained& what);

}  // namespace plumb::offline
