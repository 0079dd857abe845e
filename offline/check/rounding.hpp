// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/arm_state.hpp"

namespace plumb::offline {

/// Joint readings that were rounded: all of them are multiples of one power of ten of their unit.
struct Rounding {
  double step = 0.0;        // [rad] or [m], the coarsest of all joints
  std::string unit;         // of that column
  double step_in_unit = 0;  // 0.01
  double at_tool_m = 0.0;   // RMS 3-D error at the reflector if every reading is off by up to half
};

/// Nothing if the files do not say how they were written. A uniform error of +-step/2 has sigma =
/// step / sqrt(12); at the tool it is sqrt(sum_j |J_j|^2) of that, RMS over the poses.
std::optional<Rounding> joint_rounding(const Cell& cell, const Measurements& measured,
                                       const std::vector<int>& rows, const ArmState& placed);

}  // namespace plumb::offline
