// SPDX-License-Identifier: Apache-2.0
#include "cli/next_line.hpp"

#include <string_view>

#include "program/shell_word.hpp"
#include "show/block.hpp"

namespace plumb::offline::cli {

std::string to_type(const Globals& globals, const std::string& words) {
  const std::string plumb = command_in("plumb", globals.directory);
  std::string out = plumb + words;
  constexpr std::string_view kAnother = " && plumb ";
  const std::string another = " && " + plumb;
  for (std::size_t at = 0; (at = out.find(kAnother, at)) != std::string::npos; at += another.size())
    out.replace(at, kAnother.size(), another);
  return out;
}

void say_next(const Globals& globals, const std::string& words, Outcome& outcome) {
  say_next(globals, std::vector<std::string>{words}, outcome);
}

void say_next(const Globals& globals, const std::vector<std::string>& words, Outcome& outcome) {
  std::string out;
  for (const auto& one : words) {
    out += (out.empty() ? "\nNext: " : "  or: ") + to_type(globals, one) + "\n";
    if (outcome.result.contains("blocks"))
      outcome.result["blocks"].push_back(show::to_json({action_of(one)}).front());
  }
  outcome.text += out;
}

}  // namespace plumb::offline::cli
