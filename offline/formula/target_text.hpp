// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "formula/formula_problem.hpp"
#include "formula/names.hpp"

namespace plumb::offline {

/// What a formula moves, and the unit of the motion: "dq2", "pre3.rx", "post4.dz", "base.dx",
/// "tool.rz" or "tcp.x".
struct TargetText {
  format::FormulaTarget target = format::FormulaTarget::kJoint;
  std::uint8_t joint = 0;
  std::uint8_t component = 0;
  bool is_length = false;
};

std::optional<TargetText> parse_target(const std::string& text, const FormulaArm& arm,
                                       FormulaProblems& problems);

/// Every target of this arm.
std::vector<std::string> formula_targets(const FormulaArm& arm);

}  // namespace plumb::offline
