// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/observability.hpp"
#include "check/separation.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

/// What the poses of a cell can tell about its parameters.
struct IdentifiabilityReport {
  Calibration calibration;
  int candidates = 0;             // numbers of arm, frame, target and effects
  int rank = 0;                   // of all of them, by singular values
  int rank_anywhere = 0;          // of those without effects, at poses all over the joint limits
  double scaled_condition = 0.0;  // of the parameters that are fitted, columns of unit length
  Observability observability;    // of these without effects, in mm per 0.5 mm or 0.5 mrad
  std::vector<Separation> separations;
};

/// Calibrates on at most 1500 of the rows and takes the derivatives there. Throws as `calibrate`.
IdentifiabilityReport identifiability(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows);

}  // namespace plumb::offline
