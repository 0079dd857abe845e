// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "arm/arm_state.hpp"
#include "solve/many_rows.hpp"

namespace plumb::offline {

/// The Jacobian at `state`, some rows at a time: visit(place of the first row in `data.rows`,
/// whitened lines of these rows, shape (rows * per_pose, parameters)). Calls come from several
/// threads.
void visit_jacobian(const FitData& data, const ArmState& state,
                    const std::vector<Parameter>& parameters,
                    const std::function<void(int, const RowMajorMatrix&)>& visit);

}  // namespace plumb::offline
