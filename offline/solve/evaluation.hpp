// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Whitened residuals and derivatives at `start`, without solving.
Solution evaluate(const FitData& data, const ArmState& start,
                  const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
