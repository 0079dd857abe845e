// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace plumb::offline {

/// One short paragraph about a message, a physical effect or a word of the field.
struct Explanation {
  std::string_view name;
  std::string_view text;
};

std::span<const Explanation> effect_explanations();
std::span<const Explanation> term_explanations();
std::span<const Explanation> status_explanations();

/// Codes of everything but reading files, which has its own list in cell/.
std::span<const Explanation> code_explanations();

}  // namespace plumb::offline
