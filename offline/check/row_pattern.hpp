// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/arm_state.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Readings whose errors repeat from row to row with a period of 2 to 12 (W-CHECK-PATTERN, once a
/// file): every second or every n-th one is off by one vector, in the tracker's axes or in the
/// tool's. Two faces of an instrument, two stations or two reflectors in turn do that.
///
/// Silent unless the pattern makes up a fifth of what the fit leaves and is no chance, and where
/// the joint positions, the directions of their moves, the payload or a temperature follow the same
/// pattern: these may then be the cause. Cost: 20 us a row, of at most 20,000 rows a file.
std::vector<Problem> pattern_findings(const MeasurementFiles& measured,
                                      const std::vector<int>& rows, const ArmState& fitted);

}  // namespace plumb::offline
