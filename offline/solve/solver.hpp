// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Least squares over `parameters` from `start` with Ceres (Levenberg-Marquardt, exact
/// derivatives), until an iteration gains less than `tolerance` of the cost, or until many of them
/// together move the predicted points by less than a small share of the noise: parameters that the
/// points do not show may then still be on their way. With `parameters` empty it only evaluates.
Solution solve(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters,
               double tolerance = 1e-12);

}  // namespace plumb::offline
