// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "arm/arm_state.hpp"

namespace plumb::offline {

/// Rotates errors [m] of measured points from the measurement frame into the tool frame, shape
/// (n, 3) both. `some`: the poses at which they were measured.
Rows3 errors_in_tool(const ArmState& state, const Measurements& some, const Rows3& errors_M);

}  // namespace plumb::offline
