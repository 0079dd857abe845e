// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Numbers of [effects] that no arm has: a reference temperature in kelvin, a reversal that takes
/// half a turn, a drift that settles for months (W-CHECK-EFFECT, at their line).
std::vector<Problem> option_findings(const Cell& cell);

/// Effects of the fitted model that move a measured point by more than 2 % of the arm's length, as
/// a backlash of decimetres would (W-CHECK-EFFECT). Cost: one prediction of 300 rows an effect.
std::vector<Problem> effect_size_findings(const Cell& cell, const Measurements& measured,
                                          const std::vector<int>& rows, const ArmState& fitted);

}  // namespace plumb::offline
