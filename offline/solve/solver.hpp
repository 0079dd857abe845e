// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Least squares over `parameters` from `start` with Ceres (Levenberg-Marquardt, exact
/// derivatives). It ends when an iteration lowers the cost by less than the share `tolerance`, or
/// when ten iterations together move the predicted points by less than a small share of the noise;
/// parameters that the points hardly show may not have converged by then. With `parameters` empty
/// it only evaluates.
Solution solve(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters,
               double tolerance = 1e-12);

}  // namespace plumb::offline
