// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// What the shape of an arm and its poses say before any fitting. SI.
struct ArmShape {
  std::vector<double> angle_to_next;  // between the axes of joint i and i + 1, 0 .. pi/2 [rad]
  std::vector<double> used;           // range of each joint in the data [rad] or [m]
  std::vector<double> limits;         // and what its limits allow
  double reflector_off_last_axis_m = 0.0;
  bool flat = false;  // the measured points lie in a plane to 1 % of their spread
};

ArmShape arm_shape(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
                   const ArmState& state);

}  // namespace plumb::offline
