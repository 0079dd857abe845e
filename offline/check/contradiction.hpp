// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// A part of 8 % to 45 % of the readings contradicts an arm that fits all the others, with a clear
/// gap between the two (W-CHECK-CONTRADICT): too many to be outliers that are simply left out.
/// Least trimmed squares with concentration steps [Rousseeuw & Van Driessen 2006], the arm held
/// near nominal. Silent where the fit `placed` leaves less than 0.1 mm, and where these rows follow
/// one another or differ from the rest in the joint positions or in a column.
/// Cost: at most some 30 regularised fits of 300 rows.
std::optional<Problem> contradiction(const Cell& cell, const MeasurementFiles& measured,
                                     const std::vector<int>& rows, const ArmState& placed);

}  // namespace plumb::offline
