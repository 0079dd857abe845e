// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formula/names.hpp"
#include "formula/parameter_text.hpp"
#include "formula/tokens.hpp"

namespace plumb::offline {

/// One node of an expression tree. The leaves are numbers, parameters and variables.
struct ExpressionNode {
  format::FormulaOp op = format::FormulaOp::kLiteral;
  int operand = 0;              // index of the parameter, joint, axis or sensor (of `sensors`)
  bool is_number = false;       // false for a literal in place of unreadable text
  double value = 0.0;           // the value of a number
  std::vector<int> inner = {};  // the operands of an operation, in order
  /// The unit. Nothing means any unit, as for 0, or an unknown one because of an error in an
  /// operand.
  std::optional<Dimension> dimension = {};
  std::optional<double> constant = {};  // its value if it is constant
  std::size_t at = 0, length = 0;       // what the caret points at: an operator or a name
  std::size_t first = 0, last = 0;      // the whole text of the node
};

/// An expression as a tree; children stand before their parents, the root last.
struct Expression {
  std::vector<ExpressionNode> nodes;
  std::vector<std::string> sensors;  // temperatures read, in the order of their first use
  bool complete = false;             // false after a syntax error
};

/// Reads the whole text. What cannot be understood is reported and replaced by a number of any
/// unit.
Expression parse_expression(const std::string& text, const std::vector<ParameterText>& parameters,
                            const FormulaArm& arm, FormulaProblems& problems);

/// Determines units and constants from the leaves to the root, and reports units that do not match.
void check_units(Expression& expression, FormulaProblems& problems);

/// The stack code of a complete expression. Constants are folded, and every literal is stored once.
struct EmittedCode {
  std::vector<std::uint16_t> code;
  std::vector<double> literals;
  int depth = 0;  // largest number of values on the stack
};
EmittedCode emit(const Expression& expression);

}  // namespace plumb::offline
