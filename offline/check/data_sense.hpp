// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "effects/data_sense.hpp"

namespace plumb::offline {

/// What these measurements could show.
///
/// @param rows  Those that are used.
DataSense data_sense(const Cell& cell, const MeasurementFiles& measured,
                     const std::vector<int>& rows);

}  // namespace plumb::offline
