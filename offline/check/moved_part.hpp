// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// A part of the cell that moved once during the measurement, by so much that it causes a large
/// part of the residual (W-CHECK-MOVED).
struct MovedPart {
  std::string words;  // "the tracker or the base moved by some 15 mm between lines 61 and 62"
  Problem finding;
};

/// The jump of the residual, in the order of measuring, that explains most of it, by the rule of
/// `plumb compare` (main_jump). Nothing if drift, a change of payload, another missing effect or
/// chance may explain it as well.
/// rows: those to use, without outliers; fitted: the state whose residual is examined.
/// Cost: 30 ms for 1,000 rows.
std::optional<MovedPart> moved_part(const Cell& cell, const MeasurementFiles& measured,
                                    const std::vector<int>& rows, const ArmState& fitted);

}  // namespace plumb::offline
