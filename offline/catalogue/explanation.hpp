// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plumb::offline {

/// One short paragraph about a message, a physical effect or a word of the field.
struct Explanation {
  const char* name;
  const char* text;
};

std::span<const Explanation> effect_explanations();
std::span<const Explanation> term_explanations();
std::span<const Explanation> status_explanations();

/// Codes of everything but reading files, which has its own list in cell/.
std::span<const Explanation> code_explanations();

}  // namespace plumb::offline
