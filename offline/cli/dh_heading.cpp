// SPDX-License-Identifier: Apache-2.0
#include "cli/dh_heading.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "cell/units.hpp"
#include "import/unit_words.hpp"
#include "program/problem.hpp"
#include "program/utf8.hpp"

namespace plumb::offline::cli {
namespace {

using Words = std::pair<std::string_view, std::string_view>;

/// Small letters, Greek ones spelled out, "alpha_{i-1}" as "alpha_i-1".
std::string plain_heading(std::string_view header) {
  constexpr std::array kLetters{Words{"α", "alpha"}, Words{"β", "beta"}, Words{"θ", "theta"},
                                Words{"ϑ", "theta"}, Words{"−", "-"},    Words{"º", "°"}};
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
  for (const std::string_view index : {"_i-1", "i-1", "_i", "i", "_j", "j"})
    if (word.size() > index.size() && word.ends_with(index))
      for (const std::string_view name : {"alpha", "a", "d", "theta", "beta"})
        if (word.substr(0, word.size() - index.size()) == name) return std::string(name);
  return "";
}

/// "a [mm]" as "a" and "mm"; the unit is empty if none stands in brackets or behind / or a comma.
std::pair<std::string, std::string> split_brackets(const std::string& header) {
  const auto at = header.find_first_of("[(/,");
  if (at == std::string::npos || at == 0) return {header, ""};
  std::string unit = header.substr(at + 1);
  while (!unit.empty() && (unit.back() == ']' || unit.back() == ')' || unit.back() == ' '))
    unit.pop_back();
  std::string name(trimmed(std::string_view(header).substr(0, at)));
  if (name.ends_with("_")) name.pop_back();
  return {name, std::string(trimmed(unit))};
}

/// As written, so that "mm" and "Mm" are told apart by known_unit.
bool is_nearly_a_unit(const std::string& text) {
  return foreign_unit(text) != nullptr || did_you_mean(text, unit_names()).has_value();
}

}  // namespace

DhHeading read_dh_heading(std::string_view header) {
  const std::string text = plain_heading(header);
  if (std::string name = known_name(text); !name.empty()) return {std::move(name)};
  auto [word, unit] = split_brackets(text);
  const bool in_brackets = !unit.empty();
  if (!in_brackets) {
    const auto at = text.find_last_of("_ ");
    const auto degree = text.find("°");
    if (degree != std::string::npos && degree > 0)
      word = text.substr(0, degree), unit = text.substr(degree);
    else if (at != std::string::npos && at > 0)
      word = text.substr(0, at), unit = text.substr(at + 1);
  }
  std::string name = known_name(word);
  if (name.empty() || name == "joint" || name == "type") return {};
  const std::string known = known_unit(unit);
  if (!known.empty()) return {std::move(name), known};
  if (in_brackets || is_nearly_a_unit(unit)) return {std::move(name), "", unit};
  return {};
}

}  // namespace plumb::offline::cli
