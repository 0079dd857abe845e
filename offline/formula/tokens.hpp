// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formula/formula_problem.hpp"

namespace plumb::offline {

/// A token of an expression: a number, a name, a unit or an operator.
struct Token {
  enum class Kind { kNumber, kName, kUnit, kSign, kEnd } kind = Kind::kEnd;
  std::size_t at = 0, length = 0;
  std::string text = {};  // of a unit, the text between the brackets
  double value = 0.0;     // of a number
};

/// The tokens of a text; the last one is kEnd. Text that is not a token is reported once and ends
/// the list.
std::vector<Token> tokens_of(std::string_view text, FormulaProblems& problems);

}  // namespace plumb::offline
