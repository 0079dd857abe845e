// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formula/names.hpp"
#include "formula/parameter_text.hpp"
#include "formula/tokens.hpp"

namespace plumb::offline {

/// One place of an expression's tree. Leaves are numbers, parameters and variables.
struct ExpressionNode {
  format::FormulaOp op = format::FormulaOp::kLiteral;
  int operand = 0;              // parameter, joint, axis; temperature: which of `sensors`
  bool is_number = false;       // else a literal stands for what could not be read
  double value = 0.0;           // of a number
  std::vector<int> inner = {};  // of an operation, in order
  /// Its unit; nothing: any, as of 0, or unknown because of an error below.
  std::optional<Dimension> dimension = {};
  std::optional<double> constant = {};  // its value if it never changes
  std::size_t at = 0, length = 0;       // what a caret points at: the sign, the name
  std::size_t first = 0, last = 0;      // all of it
};

/// An expression as a tree; children stand before their parents, the root last.
struct Expression {
  std::vector<ExpressionNode> nodes;
  std::vector<std::string> sensors;  // temperatures read, in the order of their first use
  bool complete = false;             // false after a syntax error
};

/// Reads the whole text; what it cannot resolve is reported and stands as a number of any unit.
Expression parse_expression(const std::string& text, const std::vector<ParameterText>& parameters,
                            const FormulaArm& arm, FormulaProblems& problems);

/// Fills in units and constants from the leaves up; reports what does not fit together.
void check_units(Expression& expression, FormulaProblems& problems);

/// The stack code of a complete expression: constants folded, each literal once.
struct EmittedCode {
  std::vector<std::uint16_t> code;
  std::vector<double> literals;
  int depth = 0;  // numbers on the stack at most
};
EmittedCode emit(const Expression& expression);

}  // namespace plumb::offline
