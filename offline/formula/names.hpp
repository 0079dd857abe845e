// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formula/dimension.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// The properties of an arm that its formulas depend on.
struct FormulaArm {
  std::vector<bool> slides;  // one per joint
  int joints() const { return static_cast<int>(slides.size()); }
};

/// A name that an expression may read.
struct Variable {
  format::FormulaOp op = format::FormulaOp::kTime;
  int operand = 0;
  Dimension dimension;
  std::string sensor = {};  // of a temperature, such as "temp_arm"; its operand is set later
};

/// Finds a variable by name: q1 tau1 dir1 travel1 u1 …, t, temp and temp_NAME, payload, x y z, row.
std::optional<Variable> find_variable(const std::string& name, const FormulaArm& arm);

struct Function {
  const char* name;
  format::FormulaOp op;
  int arguments;
};
const Function* find_function(const std::string& name);

/// Every variable of this arm and every function, for "did you mean".
std::vector<std::string> formula_names(const FormulaArm& arm);

/// True for variables of any arm, functions and pi. A parameter cannot have such a name.
bool is_reserved(const std::string& name);

/// True for a letter followed by letters, digits and _, such as "motor_heat".
bool is_plain_name(const std::string& name);

}  // namespace plumb::offline
