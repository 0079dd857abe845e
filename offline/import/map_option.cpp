// SPDX-License-Identifier: Apache-2.0
#include "import/map_option.hpp"

#include <fmt/format.h>

#include "program/shell_word.hpp"

namespace plumb::offline {

std::string map_option(const std::vector<std::string>& wishes) {
  const std::string text = fmt::format("{}", fmt::join(wishes, ","));
  // Inside double quotes these still mean something to a shell.
  if (text.find_first_of("\"$`\\!") != text.npos) return "--map " + shell_word(text);
  return fmt::format("--map \"{}\"", text);
}

}  // namespace plumb::offline
