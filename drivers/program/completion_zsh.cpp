// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "program/completion.hpp"

namespace plumb {
namespace {

/// Text between single quotes in which zsh gives no meaning to brackets and colons.
std::string quotable(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

/// What completes a value: its words, or files.
std::string action(const OptionRow& row) {
  if (!row.words.empty()) return fmt::format("({})", fmt::join(row.words, " "));
  return row.value == "DIR" ? "_files -/" : "_files";
}

std::string option_spec(const OptionRow& row) {
  std::string out;
  for (const auto& name : row.names) {
    const bool takes = !row.value.empty();
    const std::string excludes =
        row.names.size() > 1 ? fmt::format("({})", fmt::join(row.names, " ")) : "";
    out += fmt::format(" \\\n        '{}{}{}{}[{}]", row.repeated ? "*" : excludes, name,
                       takes && name.starts_with("--") ? "=" : "",
                       takes && !name.starts_with("--") ? "+" : "", quotable(row.help));
    if (takes) out += ":" + quotable(row.value) + ":" + action(row);
    out += "'";
  }
  return out;
}

std::string positional_spec(const OptionRow& row) {
  return fmt::format(" \\\n        '{}:{}:{}'", row.repeated ? "*" : "",
                     quotable(row.names.front()), action(row));
}

std::string zsh_verb_case(const VerbRow& verb) {
  std::string out = fmt::format("    {})\n      _arguments", verb.name);
  for (const auto& row : verb.options) out += option_spec(row);
  for (const auto& row : verb.positionals) out += positional_spec(row);
  return out + "\n      ;;\n";
}

}  // namespace

std::string zsh_completion(const CommandTable& table) {
  const std::string function = function_name(table.program);
  std::string out = fmt::format(
      "#compdef {}\n# SPDX-License-Identifier: Apache-2.0\n_{}() {{\n"
      "  local context state state_descr line\n  typeset -A opt_args\n  local -a verbs\n"
      "  verbs=(\n",
      table.program, function);
  for (const auto& verb : table.verbs)
    out += fmt::format("    '{}:{}'\n", verb.name, quotable(verb.summary));
  out += "  )\n  _arguments -C";
  for (const auto& row : table.options) out += option_spec(row);
  out += " \\\n        '1:verb:->verb' \\\n        '*::word:->words'\n";
  out += "  if [[ $state == verb ]]; then\n    _describe -t verbs verb verbs\n    return\n  fi\n";
  out += "  [[ $state == words ]] || return\n  case $words[1] in\n";
  for (const auto& verb : table.verbs) out += zsh_verb_case(verb);
  // zsh runs the file as the function itself where it finds it by its name; else it is sourced.
  return out + fmt::format(
                   "  esac\n}}\nif [[ $funcstack[1] == _{0} ]]; then\n  _{0} \"$@\"\nelse\n"
                   "  compdef _{0} {1}\nfi\n",
                   function, table.program);
}

}  // namespace plumb
