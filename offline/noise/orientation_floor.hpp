// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "noise/noise_floor.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// Measured orientations as matrices, row by row.
std::vector<Matrix3> rotations_of(const Rows4& quat);

/// Robust standard deviation about each axis of rotations by these angles [rad], from their median.
double sigma_of_angles(std::vector<double> angles_rad);

/// Standard deviation about each axis between readings of one group [rad], from the median
/// of pairs; nothing if there are fewer than five pairs. Readings equal to each other are copies
/// and no repeats.
std::optional<double> orientation_scatter(const Measurements& measured,
                                          const std::vector<int>& group);

/// The error of an orientation that its measurement alone would cause, whatever the model.
struct OrientationFloor {
  double sigma_rad = 0.0;  // 1 sigma about each axis
  double mean_rad = 0.0;   // mean angle: 1.596 sigma
  NoiseFloor::Source source = NoiseFloor::Source::kNone;
  bool known() const { return source != NoiseFloor::Source::kNone; }
};

/// From repeats of a pose under one context (repeat_groups.hpp) if there are at least five pairs of
/// them and they differ at all, which rounded ones need not; else from the sigma of the cell. None
/// where orientations are not measured or not used. Cost: rows.
OrientationFloor orientation_floor(const Cell& cell, const Measurements& measured);

/// "0.0110 deg".
std::string angle_words(double rad);

/// "orientations miss by 0.0110 deg, 6.0 times their noise floor 0.0018 deg of the stated sigma".
std::string missed_words(double mean_rad, const OrientationFloor& floor);

}  // namespace plumb::offline
