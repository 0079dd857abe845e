// SPDX-License-Identifier: Apache-2.0
#include "program/shell_word.hpp"

namespace plumb {

std::string shell_word(const std::string& text) {
  if (!text.empty() && text.find_first_of(" ()[]*?$&;|<>\"'`\\#~") == std::string::npos)
    return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string command_in(const std::string& program, const std::string& directory) {
  return directory.empty() ? program + " " : program + " -C " + shell_word(directory) + " ";
}

}  // namespace plumb
