// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

/// By what share the weighted RMS error of the fit poses falls from one fitted model to another, on
/// the poses that neither of them left out. A scan is linear and ignores limits
/// of size; this is what the refit really achieved.
double rms_reduction(const Cell& cell, const Measurements& measured, const std::vector<int>& fit,
                     const Calibration& from, const Calibration& to);

}  // namespace plumb::offline
