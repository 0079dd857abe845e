// SPDX-License-Identifier: Apache-2.0
#include "rt/restart_reasons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/toml_table.hpp"
#include "rt/check_sums.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

toml::table parsed_settings(const fs::path& folder) {
  const fs::path file = folder / "rt.toml";
  return TomlSource(display_name(file), read_regular_file(file, kMostCellBytes), "E-RT").parse();
}

/// As a list of check sums names it, however rt.toml spells it.
std::string model_name(const fs::path& folder, const toml::table& settings) {
  return listed_name(folder,
                     folder / settings["model"]["file"].value_or(std::string("robot.plumb")));
}

/// Names and sums of the files that decide, beside rt.toml and the model.
std::map<std::string, std::string> other_files(const fs::path& folder, const std::string& model) {
  std::map<std::string, std::string> out;
  for (const auto& [name, sum] : listed_sums(folder, sums_text(folder))) {
    const fs::path path = name;
    const bool for_people = path.extension() == ".dbc" || path.extension() == ".md";
    if (name != "rt.toml" && name != model && !for_people) out[name] = sum;
  }
  return out;
}

/// Adds the keys at which two tables differ, those of inner tables by their own names.
void compare_tables(const toml::table& a, const toml::table& b, const std::string& name,
                    std::vector<std::string>& out) {
  std::vector<std::string> keys;
  for (const auto* table : {&a, &b})
    for (const auto& [key, value] : *table)
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
        keys.emplace_back(key.str());
  for (const std::string& key : keys) {
    const toml::node* const x = a.get(key);
    const toml::node* const y = b.get(key);
    if (name.empty() && key == "model") continue;
    const std::string full = name.empty() ? key : name + "." + key;
    const bool tables = x != nullptr && y != nullptr && x->is_table() && y->is_table();
    if (tables)
      compare_tables(*x->as_table(), *y->as_table(), full, out);
    else if (x == nullptr || y == nullptr || toml::node_view(*x) != toml::node_view(*y))
      out.push_back(name.empty() ? key : fmt::format("[{}] {}", name, key));
  }
}

}  // namespace

std::vector<std::string> restart_reasons(const fs::path& running, const fs::path& next) {
  std::vector<std::string> out;
  const toml::table a = parsed_settings(running), b = parsed_settings(next);
  compare_tables(a, b, "", out);
  const auto files = other_files(running, model_name(running, a));
  auto others = other_files(next, model_name(next, b));
  for (const auto& [name, sum] : files) {
    const auto at = others.find(name);
    if (at == others.end() || at->second != sum) out.push_back(name);
    if (at != others.end()) others.erase(at);
  }
  for (const auto& [name, sum] : others) out.push_back(name);
  return out;
}

}  // namespace plumb::drivers::rt
