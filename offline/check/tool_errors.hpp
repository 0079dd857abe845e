// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fit/arm_state.hpp"

namespace plumb::offline {

/// Errors of the measured points, given in the measurement frame, as seen from the tool [m].
/// `some`: the poses they were measured at. Shape (n, 3) both.
Rows3 errors_in_tool(const ArmState& state, const Measurements& some, const Rows3& errors_M);

}  // namespace plumb::offline
