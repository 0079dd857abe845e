// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// The whitened Jacobian of `some` rows of `all`, the lines of each set-up scaled so that it says
/// as much as with all of its rows. Shape as `evaluate`'s.
Eigen::MatrixXd jacobian_for_all(const FitData& all, const FitData& some, const ArmState& state,
                                 const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
