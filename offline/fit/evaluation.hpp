// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fit/fit_data.hpp"
#include "fit/parameter.hpp"
#include "fit/solution.hpp"

namespace plumb::offline {

/// Whitened residuals and derivatives at `start`, without solving.
Solution evaluate(const FitData& data, const ArmState& start,
                  const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
