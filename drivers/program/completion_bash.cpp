// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "program/completion.hpp"

namespace plumb {
namespace {

using Rows = std::vector<OptionRow>;

std::string names_of(const Rows& rows) {
  std::vector<std::string> out;
  for (const auto& row : rows) out.insert(out.end(), row.names.begin(), row.names.end());
  return fmt::format("{}", fmt::join(out, " "));
}

/// The values of the options of one verb, or of the program where `verb` is empty.
std::string value_cases(const std::string& verb, const Rows& rows) {
  std::string out;
  for (const auto& row : rows) {
    if (row.value.empty()) continue;
    std::vector<std::string> patterns;
    for (const auto& name : row.names) patterns.push_back(verb + ":" + name);
    out += fmt::format("    {}) words='{}' ;;\n", fmt::join(patterns, " | "),
                       fmt::join(row.words, " "));
  }
  return out;
}

std::string verb_case(const VerbRow& verb) {
  std::vector<std::string> words;
  for (const auto& row : verb.positionals)
    words.insert(words.end(), row.words.begin(), row.words.end());
  return fmt::format("    {}) options='{}' words='{}' ;;\n", verb.name, names_of(verb.options),
                     fmt::join(words, " "));
}

constexpr auto kBegin = R"sh(# SPDX-License-Identifier: Apache-2.0
# Completion of {program} in bash.
_{function}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} verb='' options='' words='' i
  # bash makes three words of --option=value.
  if [[ $current == '=' ]]; then
    current=''
  elif [[ $before == '=' ]]; then
    before=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${{COMP_WORDS[i]}} in
      -C) ((i++)) ;;
      -* | =) ;;
      *)
        verb=${{COMP_WORDS[i]}}
        break
        ;;
    esac
  done
  case $verb in
)sh";

constexpr auto kValues = R"sh(  esac
  case $verb:$before in
)sh";

constexpr auto kEnd = R"sh(    *) [[ $current == -* ]] && words=$options ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -F _{function} {program}
)sh";

}  // namespace

std::string function_name(const std::string& program) {
  std::string out = program;
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

std::string bash_completion(const CommandTable& table) {
  const std::string function = function_name(table.program);
  std::vector<std::string> verbs;
  for (const auto& verb : table.verbs) verbs.push_back(verb.name);
  std::string out = fmt::format(fmt::runtime(kBegin), fmt::arg("program", table.program),
                                fmt::arg("function", function));
  out += fmt::format("    '') options='{}' words='{}' ;;\n", names_of(table.options),
                     fmt::join(verbs, " "));
  for (const auto& verb : table.verbs) out += verb_case(verb);
  out += kValues + value_cases("", table.options);
  for (const auto& verb : table.verbs) out += value_cases(verb.name, verb.options);
  return out + fmt::format(fmt::runtime(kEnd), fmt::arg("program", table.program),
                           fmt::arg("function", function));
}

}  // namespace plumb
