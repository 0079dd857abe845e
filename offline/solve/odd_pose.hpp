// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// The one row of `data.rows` that all others contradict, by its place there; nothing if there is
/// none. For few poses, of which a wrong one draws the whole fit after it so that all look equally
/// bad: each is left out once, and is odd if it lies six times as far from where the others predict
/// it as these scatter then. Linearised at `solution`, a least-squares solution with its Jacobian.
/// Cost: rows * lines * parameters.
std::optional<std::size_t> odd_pose(const FitData& data, const Solution& solution);

}  // namespace plumb::offline
