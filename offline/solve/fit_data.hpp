// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "solve/known_arm.hpp"
#include "solve/weak_directions.hpp"

namespace plumb::offline {

/// What a geometric fit is weighed with: rows used, and 1 sigma of each coordinate.
struct FitData {
  const Measurements* measured = nullptr;
  std::vector<int> rows;
  Rows3 sigma_m;               // shape (all poses, 3)
  double sigma_rad = 0.0;      // 0: orientation is not used
  const Cell* cell = nullptr;  // with its priors, or null: none
  WeakDirections weak = {};    // held near nominal; the parameters of a fit must contain theirs
  KnownArm arm = {};           // what an earlier calibration says of the numbers fitted
  bool series = false;         // solves for the numbers of series of waves as well

  int per_pose() const;        // residuals of one pose
  int residual_count() const;  // of all poses, priors not counted
};

}  // namespace plumb::offline
