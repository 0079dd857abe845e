// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/measurements.hpp"
#include "fit/noise_floor.hpp"

namespace plumb::offline {

/// Rows with the very digits of another row's point (W-CHECK-COPY): a true repeat has its own
/// reading. Repeats of one pose that rounding may have made equal are not called copies; where
/// nothing tells the noise, it is said that they may be either.
std::vector<Problem> copy_findings(const MeasurementFiles& measured, const NoiseFloor& floor);

/// Poses that are all equal (E-CHECK-EQUAL).
std::vector<Problem> equal_pose_findings(const MeasurementFiles& measured);

}  // namespace plumb::offline
