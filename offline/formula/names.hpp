// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formula/dimension.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// What a formula must know of the arm it belongs to.
struct FormulaArm {
  std::vector<bool> slides;  // one per joint
  int joints() const { return static_cast<int>(slides.size()); }
};

/// A name that an expression may read.
struct Variable {
  format::FormulaOp op = format::FormulaOp::kTime;
  int operand = 0;
  Dimension dimension;
  std::string sensor = {};  // of a temperature: "temp_arm"; its operand is given later
};

/// q1 tau1 dir1 travel1 u1 …, t, temp and temp_NAME, payload, x y z, row.
std::optional<Variable> find_variable(const std::string& name, const FormulaArm& arm);

struct Function {
  const char* name;
  format::FormulaOp op;
  int arguments;
};
const Function* find_function(const std::string& name);

/// Every variable of this arm and every function, for "did you mean".
std::vector<std::string> formula_names(const FormulaArm& arm);

/// A variable of some arm, a function or pi: no name for a parameter.
bool is_reserved(const std::string& name);

/// "motor_heat": a letter, then letters, digits and _.
bool is_plain_name(const std::string& name);

}  // namespace plumb::offline
