// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline {

/// What is wrong with a formula, and where in its texts; how it is shown is the cell reader's.
struct FormulaProblem {
  enum class Kind { kSyntax, kVariable, kUnit, kNoNumber, kTooLong, kParameter, kTarget, kDomain };
  enum class Field { kTarget, kExpression, kParameter };
  Kind kind = Kind::kSyntax;
  Field field = Field::kExpression;
  std::size_t parameter = 0;                 // which, if the field is that
  std::size_t at = 0, length = 1;            // characters of that text
  std::string message = {};                  // one sentence without a full stop
  std::string label = {};                    // behind the caret
  std::string help = {};                     // one line to paste
  std::string word = {};                     // what may be misspelt
  std::vector<std::string> candidates = {};  // what may be meant by it
};

using FormulaProblems = std::vector<FormulaProblem>;

}  // namespace plumb::offline
