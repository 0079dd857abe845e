// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// The user's own formula, bound to the data: its parameters where the fit begins, what the cycle
/// must be told, and what stands in where that is unknown (0 for directions and travels, the cell's
/// payload, the mean of these measurements for temperatures and time).
/// Throws Failure (kInput) if the measurements lack what it reads.
format::Effect bind_formula(const Cell& cell, const Measurements& measured,
                            const EffectEntry& entry);

}  // namespace plumb::offline
