// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fit/solver.hpp"

namespace plumb::offline {

/// `solve` for Jacobians that are too large to be kept (see is_many): Gauss and Newton's steps,
/// damped where they lead astray, from sums over the rows. From a start that is nearly right one or
/// two steps on all rows are enough; to one that is not, some of the rows lead.
Solution solve_many(const FitData& data, const ArmState& start,
                    const std::vector<Parameter>& parameters, double tolerance);

}  // namespace plumb::offline
