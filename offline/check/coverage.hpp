// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// How one joint is used. [rad] or [m].
struct JointCoverage {
  std::string joint;
  double q_min = 0.0, q_max = 0.0;  // used
  double limit_min = 0.0, limit_max = 0.0;
  double share = 0.0;            // of the limits, 0 .. 1
  std::array<int, 10> tenths{};  // poses in each tenth of the used range
  std::string text = {};         // "even", "nothing between 20 and 70 deg", "never moves"
};

struct Coverage {
  int poses = 0;     // distinct ones
  int readings = 0;  // rows
  std::vector<JointCoverage> joints;
  std::array<double, 3> box_min{}, box_max{};  // of the reflector in the base frame [m]
};

/// rows: those that are used, not empty.
Coverage coverage(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
                  const ArmState& placed);

/// Joints that use less than half of their limits (W-CHECK-COVERAGE, once for all).
std::vector<Problem> coverage_findings(const Coverage& coverage);

}  // namespace plumb::offline
