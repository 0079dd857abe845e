// SPDX-License-Identifier: Apache-2.0
#include "import/heading.hpp"

#include <fmt/format.h>

#include <regex>

#include "import/unit_words.hpp"

namespace plumb::offline {
namespace {

struct Split {
  std::string name, unit;
};

Split split_unit(const std::string& text, std::string (*read_unit)(std::string)) {
  static const std::regex kBrackets(R"(^(.*?)\s*[\[\(\{<]\s*([^\]\)\}>]*)\s*[\]\)\}>]\s*$)");
  static const std::regex kTail(R"(^(.*?)\s*[/_\s,]\s*([^\s/_,]+)\s*$)");
  static const std::regex kDegree(R"(^(.*[^\s])\s*((?:°|º|˚)C?)\s*$)");
  std::smatch match;
  for (const auto* pattern : {&kBrackets, &kTail, &kDegree})
    if (std::regex_match(text, match, *pattern))
      if (const std::string unit = read_unit(match[2]); !unit.empty()) return {match[1], unit};
  return {text, ""};
}

}  // namespace

WrittenHeading read_heading(const std::string& text) {
  if (text.size() > kLongestHeading) return {text, "", ""};
  const Split known = split_unit(text, known_unit);
  if (!known.unit.empty()) return {known.name, known.unit, ""};
  const Split other = split_unit(text, unit_of_others);
  return {other.name, "", other.unit};
}

std::string in_short(const std::vector<std::string>& names) {
  if (names.size() <= 4) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{}, {}, ... {}", names[0], names[1], names.back());
}

}  // namespace plumb::offline
