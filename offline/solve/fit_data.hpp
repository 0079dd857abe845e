// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "observe/line_table.hpp"
#include "observe/reading.hpp"
#include "solve/known_arm.hpp"
#include "solve/touch_density.hpp"
#include "solve/weak_directions.hpp"

namespace plumb::offline {

/// The readings of a fit with the standard deviation of each coordinate, and what is known beside
/// them.
struct FitData {
  const Measurements* measured = nullptr;
  std::vector<int> rows;
  Rows3 sigma_m;               // shape (all poses, 3)
  double sigma_rad = 0.0;      // 0: orientation is not used
  const Cell* cell = nullptr;  // gives the priors of the fit; null: there are none
  WeakDirections weak = {};    // held near nominal; their parameters must be among those fitted
  KnownArm arm = {};           // prior of the fitted numbers by an earlier calibration
  TouchDensity touches = {};   // if rows touch fixed points
  bool series = false;         // the amplitudes of series of waves are fitted as well

  /// What a row of `measured` shows.
  Reading reading(int row) const { return {*measured, row, sigma_rad > 0.0}; }
  /// Residuals of all rows, priors not counted.
  int residual_count() const;
  /// Where those of each of `rows` stand. Cost: rows.
  LineTable line_table() const;
};

}  // namespace plumb::offline
