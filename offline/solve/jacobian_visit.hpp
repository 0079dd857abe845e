// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "arm/arm_state.hpp"
#include "solve/many_rows.hpp"

namespace plumb::offline {

/// Computes the Jacobian at `state` in blocks of rows, so that it is never held as a whole, and
/// calls visit(i, J) for each block: i is the index in `data.rows` of its first row, and J holds
/// the whitened lines of its rows, shape (lines, parameters). Calls come from several
/// threads.
void visit_jacobian(const FitData& data, const ArmState& state,
                    const std::vector<Parameter>& parameters,
                    const std::function<void(int, const RowMajorMatrix&)>& visit);

}  // namespace plumb::offline
