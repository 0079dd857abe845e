// SPDX-License-Identifier: Apache-2.0
#include "workbench/names.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>

#include "program/printable.hpp"

namespace plumb::offline::workbench {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestName = 128;  // [bytes]

bool part_leads_outside(std::string_view part, const fs::path& folder) {
  if (part.empty()) return false;
  if (part.front() == '/') return true;
  const fs::path path{std::string(part)};
  if (std::any_of(path.begin(), path.end(), [](const fs::path& step) { return step == ".."; }))
    return true;
  return !lies_inside(folder / path, folder);
}

}  // namespace

bool is_plain_name(const std::string& name) {
  if (name.empty() || name.size() > kLongestName) return false;
  if (name.front() == '.' || name.front() == '-' || name.front() == ' ') return false;
  if (name.find_first_of("/\\") != std::string::npos) return false;
  return printable_line(name) == name;
}

bool lies_inside(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path top = fs::weakly_canonical(folder, error);
  if (error) return false;
  const fs::path real = fs::weakly_canonical(path, error);
  if (error) return true;  // a text too long for a path is none
  const auto [end, at] = std::mismatch(top.begin(), top.end(), real.begin(), real.end());
  return end == top.end();
}

bool leads_outside(const std::string& word, const fs::path& folder) {
  // "-oFILE" is "-o" and its value.
  std::string_view rest = word;
  if (rest.starts_with("-o")) rest.remove_prefix(2);
  while (!rest.empty()) {
    const auto at = rest.find_first_of("=:,\n");
    if (part_leads_outside(rest.substr(0, at), folder)) return true;
    if (at == std::string_view::npos) break;
    rest.remove_prefix(at + 1);
  }
  return false;
}

}  // namespace plumb::offline::workbench
