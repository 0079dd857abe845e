// SPDX-License-Identifier: Apache-2.0
#include "import/expanded.hpp"

#include <regex>
#include <vector>

#include "import/heading.hpp"
#include "import/unit_words.hpp"

namespace plumb::offline {
namespace {

/// The coverage factor of 95 %.
constexpr double kUsual = 2.0;

struct Pattern {
  std::regex regex;
  double factor;  // 0: the matched number is the factor
};

// The matched text is removed from the heading.
const std::vector<Pattern>& patterns() {
  static const std::vector<Pattern> all{
      {std::regex(R"([\(\[]?\s*\bk\s*=\s*([0-9]+(?:[.,][0-9]+)?)\s*[\)\]]?)", std::regex::icase),
       0.0},
      {std::regex(R"([\(\[]?\s*(?:^|[\s_\(\[])([1-3])[\s_-]*(?:sigma|σ|Σ)\s*[\)\]]?)",
                  std::regex::icase),
       0.0},
      {std::regex(R"([\(\[]?\s*95(?:[.,]45)?\s*%\s*(?:conf[a-z.]*|ci)?\s*[\)\]]?)",
                  std::regex::icase),
       kUsual},
      {std::regex(R"((?:^|[\s_])u[\s_]*[\(\[]?\s*0?[.,]?95\s*[\)\]]?)", std::regex::icase), kUsual},
      {std::regex(R"((?:expanded|erweiterte|[eé]largie|estesa|expandida|拡張|扩展))",
                  std::regex::icase),
       kUsual},
  };
  return all;
}

/// Rewrites "[mm, k=2]" and "[k=2; mm]" as "[mm] (k=2)".
std::string with_factor_apart(const std::string& heading) {
  static const std::regex kBehind(
      R"(([\[\(])\s*([^\[\]\(\),;]+?)\s*[,;\s]\s*(k\s*=\s*[0-9]+(?:[.,][0-9]+)?)\s*([\]\)]))",
      std::regex::icase);
  static const std::regex kBefore(
      R"(([\[\(])\s*(k\s*=\s*[0-9]+(?:[.,][0-9]+)?)\s*[,;\s]\s*([^\[\]\(\),;0-9][^\[\]\(\),;]*?)\s*([\]\)]))",
      std::regex::icase);
  return std::regex_replace(std::regex_replace(heading, kBehind, "$1$2$4 ($3)"), kBefore,
                            "$1$3$4 ($2)");
}

bool is_unit(const std::string& text) {
  return !known_unit(text).empty() || !unit_of_others(text).empty();
}

/// The name, the word "sigma" and the unit in this order, wherever the unit was before.
std::string with_sigma(const std::string& text) {
  static const std::regex kLast(R"(^(.*?)\s*([\[\(][^\[\]\(\)]*[\]\)])\s*$)");
  static const std::regex kFirst(R"(^\s*([\[\(][^\[\]\(\)]*[\]\)])\s*(.+)$)");
  static const std::regex kTail(R"(^(.*?[^\s/_,])[\s/_,]+([^\s/_,]+)\s*$)");
  std::smatch match;
  if (std::regex_match(text, match, kLast)) return match[1].str() + " sigma " + match[2].str();
  if (std::regex_match(text, match, kFirst) && is_unit(match[1]))
    return match[2].str() + " sigma " + match[1].str();
  if (std::regex_match(text, match, kTail) && is_unit(match[2]))
    return match[1].str() + " sigma [" + match[2].str() + "]";
  return text + " sigma";
}

}  // namespace

std::optional<Expanded> expanded_uncertainty(const std::string& heading) {
  if (heading.size() > kLongestHeading) return std::nullopt;
  Expanded out{1.0, "", with_factor_apart(heading)};
  bool found = false;
  for (const auto& pattern : patterns()) {
    std::smatch match;
    if (!std::regex_search(out.rest, match, pattern.regex)) continue;
    double factor = pattern.factor;
    if (factor == 0.0) {
      std::string number = match[1];
      if (const auto comma = number.find(','); comma != number.npos) number[comma] = '.';
      factor = std::stod(number);
    }
    const std::string said = match[0];
    if (!found) {
      if (!(factor > 0.0)) return std::nullopt;
      out.factor = factor;
      out.said = said.substr(said.find_first_not_of(" _"));
    }
    found = true;
    out.rest = std::string(match.prefix()) + " " + std::string(match.suffix());
  }
  if (!found) return std::nullopt;
  out.rest = with_sigma(out.rest);
  return out;
}

}  // namespace plumb::offline
