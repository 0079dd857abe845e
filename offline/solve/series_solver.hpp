// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Whether the state carries a series of waves.
bool has_series(const ArmState& state);

/// As `solve`, but fits the amplitudes of all series of waves together with `parameters`. The
/// motion is nearly linear in the amplitudes, so the normal equations are reused for many steps. A
/// wave moves one joint only, so its sums need one number a pose instead of one a coordinate. As
/// there, it also ends once the predictions are at rest. [Gauss-Newton; Nocedal & Wright 2006,
/// 10.3]
///
/// The Jacobian of the solution is that of `parameters` alone; `marginal` is the information on
/// them with the amplitudes unknown as well.
Solution solve_with_series(const FitData& data, const ArmState& start,
                           const std::vector<Parameter>& parameters, double tolerance);

/// J^T J of the whitened readings by `parameters` and, behind them, by the amplitudes of all series
/// of waves in the order of `series_numbers`. No prior is in it.
Eigen::MatrixXd series_information(const FitData& data, const ArmState& state,
                                   const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
