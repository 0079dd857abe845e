// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Index in `data.rows` of the one row that all others contradict; nothing if there is none. For
/// few poses, of which a wrong one pulls the fit so far that all residuals look equally large. Each
/// pose is left out once; it is odd if it lies more than six times the scatter of the others from
/// where they predict it, per coordinate. Of several the farthest one is returned. Linearised at
/// `solution`, a least-squares solution with its Jacobian.
/// Cost: rows * lines * parameters.
std::optional<std::size_t> odd_pose(const FitData& data, const Solution& solution);

}  // namespace plumb::offline
