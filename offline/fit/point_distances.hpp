// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "fit/calibration.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// Where a touched point is in the base frame [m].
Vector3 touched_point_B(const Calibration& calibration, int setup);

/// How far two touched points are from each other by the calibrated arm.
struct PointDistance {
  int from = 0, to = 0;  // set-ups of the two points
  double length_m = 0.0;
  double half_m = 0.0;             // half of its 95 % interval
  std::optional<double> stated_m;  // as the columns to_point and distance say
};

/// Of two points, or of all pairs of points whose distance is stated, and of those in one placement
/// (column `position`): who made the artefact can compare. A stated distance was fitted as well.
PointDistance point_distance(const MeasurementSettings& settings, const Calibration& calibration,
                             int from, int to);
std::vector<PointDistance> point_distances(const MeasurementSettings& settings,
                                           const Calibration& calibration);

/// "'A' and 'B' are 50.012 mm apart, give or take 0.050 mm (stated: 50 mm)".
std::string distance_words(const MeasurementSettings& settings, const PointDistance& distance);

}  // namespace plumb::offline
