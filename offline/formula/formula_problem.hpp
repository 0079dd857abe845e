// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline {

/// A problem of a formula and its place in the texts. The cell reader shows it to the user.
struct FormulaProblem {
  enum class Kind { kSyntax, kVariable, kUnit, kNoNumber, kTooLong, kParameter, kTarget, kDomain };
  enum class Field { kTarget, kExpression, kParameter };
  Kind kind = Kind::kSyntax;
  Field field = Field::kExpression;
  std::size_t parameter = 0;                 // index, if the field is kParameter
  std::size_t at = 0, length = 1;            // characters of that text
  std::string message = {};                  // one sentence without a full stop
  std::string label = {};                    // shown behind the caret
  std::string help = {};                     // one line that can be pasted
  std::string word = {};                     // a word that may be misspelt
  std::vector<std::string> candidates = {};  // words that may be meant
};

using FormulaProblems = std::vector<FormulaProblem>;

}  // namespace plumb::offline
