// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// The user's own formula, bound to the data: the start values of its parameters, the context that
/// the cycle must provide, and the value that replaces it where it is unknown (0 for directions and
/// travels, the cell's payload, the mean of these measurements for temperatures and time).
/// Throws Failure (kInput) if the measurements lack what it reads.
format::Effect bind_formula(const Cell& cell, const Measurements& measured,
                            const EffectEntry& entry);

}  // namespace plumb::offline
