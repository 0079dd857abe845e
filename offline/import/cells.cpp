// SPDX-License-Identifier: Apache-2.0
#include "import/cells.hpp"

#include <algorithm>
#include <cctype>

#include "import/number_text.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

constexpr const char* kCommentSigns[] = {"#", "//", "%", "*", "!"};

std::string_view unquoted(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = cell.substr(1, cell.size() - 2);
  return trimmed(cell);
}

Cells cut_blanks(std::string_view line) {
  Cells out;
  for (;;) {
    line = trimmed(line);
    if (line.empty()) return out;
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    out.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

/// The end of the quoted text that begins at `first`, behind its quote; `first` if it has none.
std::size_t behind_quote(std::string_view line, std::size_t first, char separator) {
  for (auto at = line.find('"', first + 1); at != line.npos; at = line.find('"', at + 1)) {
    if (line.substr(at + 1).starts_with('"')) {
      ++at;
      continue;
    }
    const auto rest = trimmed(line.substr(at + 1));
    if (rest.empty() || rest.front() == separator || line[at + 1] == separator) return at + 1;
  }
  return first;
}

}  // namespace

Cells cut_line(std::string_view line, char separator, Brackets brackets) {
  if (separator == ' ') return cut_blanks(line);
  Cells out;
  int open = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size()) {
      const char c = line[i];
      if (c == '"' && trimmed(line.substr(first, i - first)).empty())
        i = behind_quote(line, i, separator);
      if (i < line.size() && line[i] != separator) {
        if (brackets == Brackets::kKeptWhole && (c == '[' || c == '(')) ++open;
        if (brackets == Brackets::kKeptWhole && (c == ']' || c == ')'))
          open = std::max(0, open - 1);
        continue;
      }
      if (i < line.size() && open > 0) continue;
    }
    out.push_back(unquoted(line.substr(first, i - first)));
    first = i + 1;
  }
  return out;
}

Cells vector_parts(std::string_view cell) {
  constexpr std::string_view kOpen = "[({", kClose = "])}";
  if (cell.size() < 5) return {};
  const auto kind = kOpen.find(cell.front());
  if (kind == kOpen.npos || cell.back() != kClose[kind]) return {};
  const auto inner = trimmed(cell.substr(1, cell.size() - 2));
  const char separator = inner.find(';') != inner.npos   ? ';'
                         : inner.find(',') != inner.npos ? ','
                                                         : ' ';
  Cells out = cut_line(inner, separator);
  const bool numbers = std::all_of(out.begin(), out.end(), [](std::string_view part) {
    return part.find(' ') == part.npos && number_in(part, '.').has_value();
  });
  return numbers && out.size() >= 2 ? out : Cells{};
}

bool is_comment(std::string_view line) {
  return std::any_of(std::begin(kCommentSigns), std::end(kCommentSigns),
                     [&](const char* sign) { return line.starts_with(sign); });
}

std::string_view without_comment_sign(std::string_view line) {
  for (const char* sign : kCommentSigns)
    if (line.starts_with(sign)) line = trimmed(line.substr(std::string_view(sign).size()));
  return line;
}

bool is_number(std::string_view cell) {
  // A blank may divide thousands or cells, which only the rest of the file can tell.
  const bool blank = cell.find(' ') != cell.npos;
  return (!blank && (number_in(cell, '.').has_value() || number_in(cell, ',').has_value())) ||
         measured_cell(cell).has_value() || sexagesimal(cell).has_value() ||
         !vector_parts(cell).empty();
}

bool is_time(std::string_view cell) {
  if (cell.empty() || std::isdigit(static_cast<unsigned char>(cell.front())) == 0) return false;
  if (cell.find_first_not_of("0123456789.,:/-+ TZAPMapm") != cell.npos) return false;
  const auto signs = std::count_if(cell.begin(), cell.end(),
                                   [](char c) { return c == '.' || c == '/' || c == '-'; });
  return signs >= 2 || cell.find(':') != cell.npos;
}

double number_share(Cells cells) {
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  if (cells.empty()) return 0.0;
  const auto numbers = std::count_if(cells.begin(), cells.end(), [](std::string_view cell) {
    return is_number(cell) || is_time(cell);
  });
  return static_cast<double>(numbers) / static_cast<double>(cells.size());
}

}  // namespace plumb::offline
