// SPDX-License-Identifier: Apache-2.0
#include "cell/csv_line.hpp"

#include <algorithm>

#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

/// Position of the quote that ends a text begun before `at`, or npos.
std::size_t closing_quote(std::string_view line, std::size_t at) {
  for (at = line.find('"', at); at != std::string_view::npos; at = line.find('"', at + 2))
    if (at + 1 >= line.size() || line[at + 1] != '"') return at;
  return at;
}

}  // namespace

CsvFault cut_line(std::string_view line, char separator, std::vector<CsvCell>& cells) {
  cells.clear();
  for (std::size_t at = 0;;) {
    const std::size_t first = std::min(line.find_first_not_of(" \t", at), line.size());
    std::size_t end = std::min(line.find(separator, at), line.size());
    if (first < line.size() && line[first] == '"') {
      const std::size_t close = closing_quote(line, first + 1);
      cells.push_back({line.substr(first, 1), true});
      if (close == std::string_view::npos) return CsvFault::kQuoteNotClosed;
      end = std::min(line.find(separator, close), line.size());
      const auto behind = trimmed(line.substr(close + 1, end - close - 1));
      cells.back().text = behind.empty() ? line.substr(first + 1, close - first - 1) : behind;
      if (!behind.empty()) return CsvFault::kTextAfterQuote;
    } else {
      cells.push_back({trimmed(line.substr(at, end - at)), false});
    }
    if (end == line.size()) return CsvFault::kNone;
    at = end + 1;
  }
}

std::string text_of(const CsvCell& cell) {
  std::string out(cell.text);
  if (!cell.quoted) return out;
  for (auto at = out.find("\"\""); at != std::string::npos; at = out.find("\"\"", at + 1))
    out.erase(at, 1);
  return out;
}

std::string quoted_if_needed(const std::string& text) {
  const bool plain = text.find_first_of(",;\"\r\n") == std::string::npos &&
                     !text.starts_with('#') && !text.starts_with("//") &&
                     trimmed(text).size() == text.size();
  if (plain) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "\"";
}

}  // namespace plumb::offline
