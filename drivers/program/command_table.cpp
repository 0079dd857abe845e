// SPDX-License-Identifier: Apache-2.0
#include "program/command_table.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace plumb {
namespace {

std::vector<std::string> split(const std::string& text, char between) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, between);) out.push_back(word);
  return out;
}

/// The help writes "NAME:RULE"; a name may hold colons itself, as "HOST:PORT" does.
std::size_t end_of_value_name(const std::string& type) {
  for (const auto* rule : {":{", ":[", ":>", ":INT in ", ":UINT in ", ":FLOAT in "})
    if (const auto at = type.find(rule); at != std::string::npos) return at;
  return type.size();
}

void describe_value(const std::string& type, OptionRow& row) {
  const std::size_t end = end_of_value_name(type);
  row.value = type.substr(0, end);
  const std::string rule = end == type.size() ? "" : type.substr(end + 1);
  if (rule.starts_with("{"))
    row.words = split(rule.substr(1, rule.find('}') - 1), ',');
  else if (row.value.find('|') != std::string::npos)
    row.words = split(row.value, '|');
  else
    row.range = rule.substr(rule.find(" in ") == std::string::npos ? 0 : rule.find(" in ") + 4);
}

OptionRow row_of(const CLI::Option& option) {
  OptionRow row;
  row.help = option.get_description();
  row.required = option.get_required();
  row.repeated = option.get_items_expected_max() > 1;
  if (option.nonpositional()) {
    for (const auto& name : option.get_snames()) row.names.push_back("-" + name);
    for (const auto& name : option.get_lnames()) row.names.push_back("--" + name);
  } else {
    row.names.push_back(option.get_name(true));
  }
  if (option.get_type_size() != 0) {
    describe_value(option.get_type_name(), row);
    row.preset = option.get_default_str();
  }
  return row;
}

std::vector<OptionRow> positional_rows(const CLI::App& app) {
  std::vector<OptionRow> out;
  for (const auto* option : app.get_options())
    if (!option->nonpositional()) out.push_back(row_of(*option));
  return out;
}

std::vector<OptionRow> option_rows(const CLI::App& app) {
  std::vector<OptionRow> out;
  for (const auto* option : app.get_options())
    if (option->nonpositional()) out.push_back(row_of(*option));
  return out;
}

}  // namespace

CommandTable command_table(const CLI::App& program) {
  CommandTable out{program.get_name(),
                   program.get_description(),
                   program.get_footer(),
                   option_rows(program),
                   {}};
  for (const auto* verb : program.get_subcommands([](const CLI::App*) { return true; }))
    out.verbs.push_back({verb->get_name(), verb->get_description(), verb->get_footer(),
                         positional_rows(*verb), option_rows(*verb)});
  return out;
}

}  // namespace plumb
