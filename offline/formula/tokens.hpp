// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formula/formula_problem.hpp"

namespace plumb::offline {

/// A word of an expression.
struct Token {
  enum class Kind { kNumber, kName, kUnit, kSign, kEnd } kind = Kind::kEnd;
  std::size_t at = 0, length = 0;
  std::string text = {};  // unit: what stands between the brackets
  double value = 0.0;     // number
};

/// Ends with kEnd. What is no word is reported once and ends the list.
std::vector<Token> tokens_of(std::string_view text, FormulaProblems& problems);

}  // namespace plumb::offline
