// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

struct RegularisedFit {
  ArmState state;
  double rms_m = 0.0;  // 3-D, over the rows but for gross outliers
};

/// Fits frame and target from `start` and holds the arm. Levenberg-Marquardt, at most 15 steps;
/// rows off by 6 medians, at most 5 % a round, are left out.
RegularisedFit robust_placement(const Cell& cell, const Measurements& measured,
                                const std::vector<int>& rows, const ArmState& start);

/// The same of the nominal arm, from where `fit` would start.
RegularisedFit placed_from_the_labels(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows);

/// Fits the geometry as well, each number with a prior of 5 mm or 10 mrad (1 sigma) about nominal:
/// a real arm's errors are absorbed, a wrong convention is not. Where a number would have to move
/// by more than 5 sigma, the placed arm is given back.
RegularisedFit regularised_fit(const Cell& cell, const Measurements& measured,
                               const std::vector<int>& rows, const ArmState& placed);

/// The frame that comes nearest to a linear map M of measured onto base coordinates, for the arm of
/// `cell` with the reflector at target_T.
ArmState state_near(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
                    const Eigen::Matrix3d& M, const Eigen::Vector3d& target_T);

}  // namespace plumb::offline
