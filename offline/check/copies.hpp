// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/measurements.hpp"
#include "noise/noise_floor.hpp"

namespace plumb::offline {

/// Rows whose point equals that of another row to the last digit (W-CHECK-COPY): a true repeat has
/// its own reading. Repeats of a pose that rounding may have made equal are not called copies; if
/// the noise is unknown, the finding says that they may be either.
std::vector<Problem> copy_findings(const MeasurementFiles& measured, const NoiseFloor& floor);

/// Poses that are all equal (E-CHECK-EQUAL).
std::vector<Problem> equal_pose_findings(const MeasurementFiles& measured);

}  // namespace plumb::offline
