// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// What the cell states of touched points [m]: sigma_touch_um, or sigma_um where all rows touch
/// one.
std::optional<double> sigma_of_touches(const Cell& cell, const Measurements& measured);

}  // namespace plumb::offline
