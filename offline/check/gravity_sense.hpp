// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

/// What the gravity of the cell means and whether the points agree with it.
///
/// N-CHECK-GRAVITY says how the arm then stands, where it does not stand upright: it hangs, leans
/// against a wall, is tilted. W-CHECK-GRAVITY: the joints yield under another direction. What the
/// geometry leaves is fitted by the moments that a mass at the tool has about the joints, once for
/// the direction of the cell and once along each axis of the base. Said only if another direction
/// leaves less than half of it and less than a quarter of what the cell's leaves, or if the cell's
/// leaves less than half but two or more joints yield upwards and none downwards; and only if it
/// leaves less than half of what errors with a period of one turn leave, because eccentric gears
/// look like gravity in some direction. Silent where the model has an effect besides geometry.
/// Cost: 10 ms.
std::vector<Problem> gravity_findings(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows, const Calibration& fitted);

}  // namespace plumb::offline
