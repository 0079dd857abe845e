// SPDX-License-Identifier: Apache-2.0
#include "cli/dh_heading.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "cell/units.hpp"
#include "import/heading.hpp"
#include "program/problem.hpp"
#include "program/utf8.hpp"

namespace plumb::offline::cli {
namespace {

using Words = std::pair<std::string_view, std::string_view>;

/// Small letters, Greek ones spelled out, "alpha_{i-1}" as "alpha_i-1".
std::string plain_heading(std::string_view header) {
  constexpr std::array kLetters{Words{"α", "alpha"}, Words{"β", "beta"}, Words{"θ", "theta"},
                                Words{"ϑ", "theta"}, Words{"−", "-"}};
  std::string out(trimmed(header));
  for (const auto& [letter, word] : kLetters)
    for (auto at = out.find(letter); at != std::string::npos; at = out.find(letter))
      out.replace(at, letter.size(), word);
  std::erase_if(out, [](char c) { return c == '{' || c == '}' || c == '\\' || c == '$'; });
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// The column that a word names, without an index such as _i or _i-1; empty if there is none.
std::string known_name(std::string_view word) {
  constexpr std::array kNames{
      Words{"alpha", "alpha"}, Words{"a", "a"},        Words{"d", "d"},
      Words{"theta", "theta"}, Words{"beta", "beta"},  Words{"offset", "offset"},
      Words{"q_min", "q_min"}, Words{"qmin", "q_min"}, Words{"q_max", "q_max"},
      Words{"qmax", "q_max"},  Words{"type", "type"},  Words{"joint_type", "type"},
      Words{"joint", "joint"}, Words{"link", "joint"}, Words{"name", "joint"},
      Words{"i", "joint"},     Words{"j", "joint"},    Words{"no", "joint"},
      Words{"no.", "joint"},   Words{"#", "joint"},    Words{"joint_name", "joint"}};
  word = trimmed(word);
  for (const auto& [written, name] : kNames)
    if (word == written) return std::string(name);
  for (const std::string_view index : {"_i-1", "(i-1)", "i-1", "_i", "(i)", "i", "_j", "j"})
    if (word.size() > index.size() && word.ends_with(index))
      for (const std::string_view name : {"alpha", "a", "d", "theta", "beta"})
        if (word.substr(0, word.size() - index.size()) == name) return std::string(name);
  return "";
}

/// The column that a word in front of a unit names.
std::string measured_name(std::string_view word) {
  while (word.ends_with("_")) word.remove_suffix(1);
  std::string name = known_name(word);
  return name == "joint" || name == "type" ? "" : name;
}

/// Splits a heading such as "a [furlong]" or "a_mmm", in which no unit stands where one belongs.
DhHeading with_bad_unit(std::string_view text) {
  const auto at = text.find_first_of("[(/,");
  const bool marked = at != text.npos;
  const auto split = marked ? at : text.find_last_of("_ ");
  if (split == text.npos) return {};
  std::string_view unit = trimmed(text.substr(split + 1));
  while (unit.ends_with("]") || unit.ends_with(")")) unit.remove_suffix(1);
  std::string name = measured_name(text.substr(0, split));
  if (name.empty() || unit.empty()) return {std::move(name)};
  const bool nearly = marked || did_you_mean(std::string(unit), unit_names());
  return nearly ? DhHeading{std::move(name), "", std::string(unit)} : DhHeading{};
}

}  // namespace

DhHeading read_dh_heading(std::string_view header) {
  const std::string text = plain_heading(header);
  if (std::string name = known_name(text); !name.empty()) return {std::move(name)};
  WrittenHeading written = read_heading(text);
  std::string name = measured_name(written.name);
  if (name.empty() || (written.unit.empty() && written.foreign.empty())) return with_bad_unit(text);
  return {std::move(name), std::move(written.unit), std::move(written.foreign)};
}

}  // namespace plumb::offline::cli
