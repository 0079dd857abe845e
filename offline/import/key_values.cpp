// SPDX-License-Identifier: Apache-2.0
#include "import/key_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "import/cells.hpp"
#include "import/other_lines.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

/// Pairs of key and number that a line must have; lines after which a file is given up if fewer
/// than half of them are alike; and the share of all lines that must be.
constexpr std::size_t kFewestPairs = 3, kLinesToJudge = 50;
constexpr double kMostLines = 0.8;

struct Pair {
  std::string_view key, value;
};

bool is_key(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '"' ||
         static_cast<unsigned char>(c) >= 0x80;
}

std::string_view without(std::string_view text, std::string_view signs) {
  const auto first = text.find_first_not_of(signs);
  if (first == text.npos) return text.substr(text.size());
  return text.substr(first, text.find_last_not_of(signs) - first + 1);
}

/// Where the key before the sign begins: "X", "X [mm]"; the sign itself if there is none.
std::size_t begin_of_key(std::string_view line, std::size_t sign) {
  std::size_t at = sign;
  while (at > 0 && line[at - 1] == ' ') --at;
  if (at > 0 && (line[at - 1] == ']' || line[at - 1] == ')')) {
    const auto open = line.find_last_of("[(", at - 1);
    if (open == line.npos) return sign;
    at = open;
    while (at > 0 && line[at - 1] == ' ') --at;
  }
  const std::size_t end = at;
  while (at > 0 && is_key(line[at - 1])) --at;
  const char first = at < end ? line[at] : ' ';
  const bool letter = std::isalpha(static_cast<unsigned char>(first)) != 0 || first == '"' ||
                      static_cast<unsigned char>(first) >= 0x80;
  return letter ? at : sign;
}

std::vector<Pair> pairs_of(std::string_view line) {
  std::vector<std::pair<std::size_t, std::size_t>> keys;  // begin, sign
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] != '=' && line[i] != ':') continue;
    if (line[i - 1] == ':' || line.substr(i + 1).starts_with(':')) continue;
    const std::size_t first = begin_of_key(line, i);
    if (first < i) keys.emplace_back(first, i);
  }
  std::vector<Pair> out;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const auto end = k + 1 < keys.size() ? keys[k + 1].first : line.size();
    const auto value = line.substr(keys[k].second + 1, end - keys[k].second - 1);
    out.push_back({without(line.substr(keys[k].first, keys[k].second - keys[k].first), " \"\t"),
                   without(value, " ,;{}\t\r\"")});
  }
  return out;
}

bool same_keys(const std::vector<Pair>& a, const std::vector<Pair>& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [](const Pair& one, const Pair& other) { return one.key == other.key; });
}

}  // namespace

std::optional<RawRows> key_values(const SourceText& text) {
  RawRows out(text);
  std::vector<Pair> keys;
  std::vector<int> others;
  std::size_t alike = 0, lines = 0;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const auto line = trimmed(text.lines[i]);
    if (line.empty() || is_comment(line)) continue;
    if (++lines == kLinesToJudge && 2 * alike < lines) return std::nullopt;
    const auto pairs = pairs_of(line);
    if (pairs.size() < kFewestPairs) {
      others.push_back(static_cast<int>(i) + 1);
      continue;
    }
    if (keys.empty()) keys = pairs;
    if (same_keys(keys, pairs)) ++alike;
    Cells row;
    for (const auto& pair : pairs) row.push_back(pair.value);
    if (!same_keys(keys, pairs) && row.size() == keys.size()) row.pop_back();  // cells are missing
    out.cells.add(row);
    out.lines.push_back(static_cast<int>(i) + 1);
  }
  if (alike < 2 || static_cast<double>(alike) < kMostLines * static_cast<double>(lines))
    return std::nullopt;
  out.dialect.separator = '=';
  out.dialect.header_line = out.lines.front();
  for (const auto& pair : keys) out.dialect.header.emplace_back(pair.key);
  std::string message = "every line names its numbers: the names became the columns";
  if (!others.empty()) message += fmt::format("; left out: {}", lines_in_words(others));
  out.remarks.push_back({.severity = Severity::kNote,
                         .code = "N-IMPORT-PAIRS",
                         .message = std::move(message),
                         .place = Place{.file = text.file, .line = out.lines.front()},
                         .help = "--map says what each of them is"});
  return out;
}

}  // namespace plumb::offline
