// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "runs/run.hpp"

namespace plumb::offline::recheck {

/// What a run leaves of readings that it was not fitted to, if nothing has changed: noise of the
/// instrument, and what the model lacks.
struct ExpectedError {
  Rows3 mean_B;                // (readings, 3) [m], base frame
  Eigen::MatrixXd covariance;  // (lines, lines) [m^2]
  /// The error of the run's numbers moves its predictions at the new readings by J e; but what the
  /// model lacks was learnt from residuals that hold J e of the old readings, so that J less W J of
  /// those counts (misfit.hpp). Empty: no old reading says anything.
  Measurements near = {};
  Eigen::MatrixXd weights = {};
  bool lacks_elsewhere = false;  // it expects more of poses where the calibration had none
};

/// The new readings, with what is expected of them. Lines stand pose by pose, `axes` lines each.
struct Readings {
  Measurements rows;
  int axes = 3;
  int poses = 0;         // different ones
  double noise_m = 0.0;  // 1 sigma of a coordinate, of the instrument
  double lacks_m = 0.0;  // 1 sigma of a coordinate, of what the model of the run lacks
  /// The first two views: what the model lacks is another thing at every pose, or it is what the
  /// earlier readings there and nearby have shown. Others, if some of the poses lie elsewhere:
  /// there it lacks several times as much.
  std::vector<ExpectedError> expected;
  int elsewhere = 0;  // readings at poses where the calibration had none (elsewhere.hpp)

  int lines() const { return rows.size() * axes; }
  double sigma_m() const;  // both together
};

/// @param calibrated  The calibration, made from `own`, the cell's measurements.
/// @param rows        The new readings.
Readings expect_readings(const Cell& cell, const Run& calibrated, const Measurements& own,
                         Measurements rows);

/// Rows of the cell's own measurements that the run was fitted to.
std::vector<int> fitted_rows(const Run& run, const Measurements& own);

/// 1 sigma of a coordinate of a reading: noise of the instrument and what the model lacks.
double expected_sigma(const Run& calibrated, const Measurements& own);

/// How many axes were measured.
int axes_of(const Measurements& rows);

}  // namespace plumb::offline::recheck
