// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/arm_state.hpp"

namespace plumb::offline {

/// A part of the cell that moved once while it was measured, by so much that it is what the fit
/// leaves (W-CHECK-MOVED).
struct MovedPart {
  std::string words;  // "the tracker or the base moved by some 15 mm between lines 61 and 62"
  Problem finding;
};

/// The jump of the residual in the order of measuring that causes most of it, by the rule of
/// `plumb compare`. Silent where drift, another payload, an effect that the model lacks, or chance
/// explain as much.
/// rows: to look at, outliers left out; fitted: the state that leaves the residual.
/// Cost: 30 ms for 1,000 rows.
std::optional<MovedPart> moved_part(const Cell& cell, const MeasurementFiles& measured,
                                    const std::vector<int>& rows, const ArmState& fitted);

}  // namespace plumb::offline
