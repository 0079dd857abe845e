// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Whether the state carries a series of waves.
bool has_series(const ArmState& state);

/// As `solve`, with the numbers of all series of waves found together with `parameters`. The motion
/// is all but linear in them, so one matrix of normal equations serves all steps; a wave acts on
/// one joint, so that its sums cost one line a pose. [Gauss-Newton; Nocedal & Wright 2006, 10.3]
///
/// The Jacobian of the solution is that of `parameters` alone; `marginal` is their information
/// with the series unknown as well.
Solution solve_with_series(const FitData& data, const ArmState& start,
                           const std::vector<Parameter>& parameters, double tolerance);

}  // namespace plumb::offline
