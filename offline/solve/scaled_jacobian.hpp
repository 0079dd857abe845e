// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// The whitened Jacobian of `some` rows of `all`. The lines of each set-up are scaled up so that
/// their information J^T J is about that of all rows of the set-up. Shape as that of `evaluate`.
Eigen::MatrixXd jacobian_for_all(const FitData& all, const FitData& some, const ArmState& state,
                                 const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
