// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline::recheck {

/// What a model lacks, as far as its own readings tell it for other poses. Each axis of it, in the
/// base frame, is a random function g of the joints with covariance
///
///   s^2 exp(-|q - q'| / l)
///
/// [Rasmussen & Williams 2006]. Where the length l is short, only a pose that is measured again
/// says something; where it is long, neighbours do, and new poses err together.
struct Misfit {
  std::vector<int> near;       // rows of the calibration that say something
  Eigen::MatrixXd weights;     // W, (readings, near): g is expected to be W times their residuals
  Eigen::MatrixXd covariance;  // (readings, readings) [m^2], of one axis
};

/// The sizes of what the model lacks and of the noise, each as 1 sigma of a coordinate.
struct MisfitSize {
  double lacks_m = 0.0;  // s
  double noise_m = 0.0;  // of a reading
  int axes = 3;          // that are measured
};

/// @param own      The calibration's measurements; `known`: its fitted rows.
/// @param error_B  What the model leaves of them, base frame [m].
/// @param rows     New readings.
/// The length is the likeliest one of a few. Cost: near^3 a length, with at most 500 near rows.
Misfit expected_misfit(const Measurements& own, const std::vector<int>& known, const Rows3& error_B,
                       const Measurements& rows, const MisfitSize& size);

}  // namespace plumb::offline::recheck
