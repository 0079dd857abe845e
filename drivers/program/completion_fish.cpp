// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "program/completion.hpp"

namespace plumb {
namespace {

/// Text between single quotes.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string option_line(const std::string& begin, const OptionRow& row) {
  std::string out = begin;
  for (const auto& name : row.names)
    out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!row.words.empty())
    out += fmt::format(" -x -a '{}'", fmt::join(row.words, " "));
  else if (!row.value.empty())
    out += " -r";
  return out + " -d " + quoted(row.help) + "\n";
}

std::string verb_lines(const std::string& program, const std::string& function,
                       const VerbRow& verb) {
  const std::string begin =
      fmt::format("complete -c {} -n 'contains {} ({})'", program, verb.name, function);
  std::string out;
  for (const auto& row : verb.options) out += option_line(begin, row);
  for (const auto& row : verb.positionals)
    if (!row.words.empty()) out += fmt::format("{} -a '{}'\n", begin, fmt::join(row.words, " "));
  return out;
}

/// A function that prints the verb of the command line, if there is one already.
constexpr auto kFunction = R"fish(# SPDX-License-Identifier: Apache-2.0
# Completion of {program} in fish.
function {function}
    set -l words (commandline -opc)
    set -e words[1]
    set -l skip no
    for word in $words
        if test $skip = yes
            set skip no
            continue
        end
        switch $word
            case -C
                set skip yes
            case '-*'
            case '*'
                echo $word
                return 0
        end
    end
    return 1
end
)fish";

}  // namespace

std::string fish_completion(const CommandTable& table) {
  const std::string function = "__" + function_name(table.program) + "_verb";
  std::string out = fmt::format(fmt::runtime(kFunction), fmt::arg("program", table.program),
                                fmt::arg("function", function));
  const std::string begin =
      fmt::format("complete -c {} -n 'not {} > /dev/null'", table.program, function);
  for (const auto& row : table.options) out += option_line(begin, row);
  for (const auto& verb : table.verbs)
    out += fmt::format("{} -f -a {} -d {}\n", begin, verb.name, quoted(verb.summary));
  for (const auto& verb : table.verbs) out += verb_lines(table.program, function, verb);
  return out;
}

}  // namespace plumb
