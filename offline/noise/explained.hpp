// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "noise/cut_search.hpp"
#include "noise/motion_sums.hpp"

namespace plumb::offline {

/// How much of the residual of a segment the motion of one part of the set-up explains, by a jump
/// or by a drift, beyond a constant shift.
struct Explained {
  const MotionSums* sums = nullptr;
  int cut = 0;                    // first visit behind the jump; 0: a drift
  double gain = 0.0, left = 0.0;  // sums of squares explained and left [m^2]
  double inflation = 1.0;         // F is divided by it: unequal variances and autocorrelation
  double free = 1.0;              // degrees of freedom left
  double ln_p = 0.0;  // ln of the probability by chance, over all cuts and motion sources
  VisitRun segment{0, 0};
  MotionSums::Numbers before, behind;  // of a jump: the motion on either side of it
  Eigen::VectorXd drift;  // of a drift: its constant, linear and quadratic coefficients

  /// The explained part of the residual of this visit.
  Eigen::Vector3d at(int visit) const;
  /// Subtracts the explained part from the residuals `error` of all visits.
  void take_from(Eigen::Matrix3Xd& error) const {
    for (int i = segment.first; i < segment.last; ++i) error.col(i) -= at(i);
  }
};

/// The residual to explain [m], and how many motion sources are tried.
struct Unexplained {
  const Eigen::Matrix3Xd& error;  // of all visits
  int axes;
  double sources;
};

/// The least number of visits on either side of a cut.
int fewest_visits(const MotionSums& sums);

/// The best cut of the segment; nothing if it is too short or no cut explains anything. `sums` must
/// have been computed from what.error.
std::optional<Explained> jump_of(const MotionSums& sums, const VisitRun& s,
                                 const Unexplained& what);

/// The best motion that is linear and quadratic in the order of the visits; nothing if the segment
/// is too short.
std::optional<Explained> drift_of(const MotionSums& sums, const VisitRun& s,
                                  const Unexplained& what);

}  // namespace plumb::offline
