// SPDX-License-Identifier: Apache-2.0
#include "import/dialect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>

#include "cell/units.hpp"
#include "import/unit_words.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kLookedLines = 200;
constexpr const char* kCommentSigns[] = {"#", "//", "%", "*", "!"};

using Cells = std::vector<std::string_view>;

bool is_comment(std::string_view line) {
  return std::any_of(std::begin(kCommentSigns), std::end(kCommentSigns),
                     [&](const char* sign) { return line.starts_with(sign); });
}

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

/// Whether a separator between brackets, as in "U(x) [mm; k=2]", divides cells too.
enum class Brackets { kCut, kKeptWhole };

Cells cut_line(std::string_view line, char separator, Brackets brackets = Brackets::kCut) {
  if (separator == ' ') return cut_blanks(line);
  Cells out;
  bool quoted = false;
  int open = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size()) {
      const char c = line[i];
      if (c == '"') quoted = !quoted;
      if (brackets == Brackets::kKeptWhole && (c == '[' || c == '(')) ++open;
      if (brackets == Brackets::kKeptWhole && (c == ']' || c == ')')) open = std::max(0, open - 1);
      if (quoted || open > 0 || c != separator) continue;
    }
    out.push_back(unquoted(line.substr(first, i - first)));
    first = i + 1;
  }
  return out;
}

bool is_number(std::string_view cell) {
  return number_in(cell, '.').has_value() || number_in(cell, ',').has_value();
}

/// "16:57", "20.10.2022 16:57": no number, but no name of a column either.
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

std::vector<std::string_view> sample(const SourceText& text) {
  std::vector<std::string_view> out;
  for (const auto line : text.lines)
    if (!trimmed(line).empty() && !is_comment(trimmed(line)) && out.size() < kLookedLines)
      out.push_back(line);
  return out;
}

/// The separator that cuts most lines into the same, largest number of cells.
char find_separator(const SourceText& text) {
  const auto lines = sample(text);
  char best = ',';
  double best_score = -1.0;
  for (char separator : {';', '\t', ',', '|', ' '}) {
    std::map<std::size_t, int> counts;
    double numbers = 0.0;
    for (const auto line : lines) {
      const Cells cells = cut_line(line, separator);
      ++counts[cells.size()];
      numbers += number_share(cells);
    }
    const auto common =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (common == counts.end() || common->first < 2) continue;
    const double share = static_cast<double>(common->second) / static_cast<double>(lines.size());
    const double score = share + numbers / static_cast<double>(lines.size());
    if (score > best_score + 1e-9) best_score = score, best = separator;
  }
  return best;
}

[[noreturn]] void fail(const SourceText& text, int line, const char* code, std::string message,
                       std::string help, std::string label = {}) {
  Place place{.file = text.file, .line = line};
  if (line > 0) {
    place.column = 1;
    place.source = std::string(text.lines[line - 1]);
    place.label = std::move(label);
  }
  throw Failure(Exit::kInput, {.code = code,
                               .message = std::move(message),
                               .place = std::move(place),
                               .help = std::move(help)});
}

/// The line above the numbers, if it holds names.
void find_header(const SourceText& text, const DialectWishes& wishes, Dialect& d,
                 std::size_t& first_row) {
  const auto is_data = [&](std::size_t i) {
    const auto line = trimmed(text.lines[i]);
    if (line.empty() || is_comment(line)) return false;
    const Cells cells = cut_line(text.lines[i], d.separator);
    return cells.size() >= 2 && number_share(cells) >= 0.5;
  };
  std::size_t data = 0;
  while (data < text.lines.size() && !is_data(data)) ++data;
  first_row = data;
  if (!wishes.header.empty()) {
    d.header = wishes.header;
    return;
  }
  const std::size_t wanted =
      data < text.lines.size() ? cut_line(text.lines[data], d.separator).size() : 2;
  std::vector<std::size_t> above;  // nearest first
  for (std::size_t i = data; i-- > 0 && above.size() < 2;) {
    auto line = trimmed(text.lines[i]);
    if (line.empty()) continue;
    if (cut_line(text.lines[i], d.separator).size() >= std::min(wanted, std::size_t{2}))
      above.push_back(i);
  }
  if (above.empty()) {
    if (data == text.lines.size())
      fail(text, 1, "E-IMPORT-HEADER", "no row of numbers was found",
           "if the separator is unusual: --separator \"|\"");
    fail(text, static_cast<int>(data) + 1, "E-IMPORT-HEADER",
         fmt::format("the file has no header: {} columns without a name", wanted),
         "name them: --header \"pose,q1_deg,q2_deg,...,x_mm,y_mm,z_mm\"", "numbers begin here");
  }
  const auto names_of = [&](std::size_t i) {
    // Not trimmed unless it is a comment: a tab at the beginning ends an empty first cell.
    std::string_view line = text.lines[i];
    for (const char* sign : kCommentSigns)
      if (const auto comment = trimmed(line); comment.starts_with(sign))
        line = trimmed(comment.substr(std::string_view(sign).size()));
    Cells cells = cut_line(line, d.separator);
    if (cells.size() != wanted) {
      Cells whole = cut_line(line, d.separator, Brackets::kKeptWhole);
      if (whole.size() == wanted) cells = std::move(whole);
    }
    return std::vector<std::string>(cells.begin(), cells.end());
  };
  // "name" over "mm" over numbers: the nearer of the two lines is the row of units.
  const auto nearest = names_of(above[0]);
  const bool units =
      above.size() > 1 &&
      std::any_of(nearest.begin(), nearest.end(),
                  [](const std::string& cell) { return !known_unit(cell).empty(); }) &&
      std::all_of(nearest.begin(), nearest.end(), [](const std::string& cell) {
        return cell.empty() || cell == "-" || cell == "[-]" || !known_unit(cell).empty() ||
               !unit_of_others(cell).empty();
      });
  d.header = units ? names_of(above[1]) : nearest;
  d.header_line = static_cast<int>(units ? above[1] : above[0]) + 1;
  if (units) d.units = nearest, d.unit_line = static_cast<int>(above[0]) + 1;
}

struct DecimalVotes {
  int comma = 0, point = 0, either = 0;
  int either_line = 0;
  int both = 0;            // "1.234,5": the point divides thousands
  int grouped_points = 0;  // "1.234": thousands if commas are decimal signs, else decimals
  int grouped_line = 0;
};

void vote(std::string_view cell, int line, DecimalVotes& votes) {
  const auto commas = std::count(cell.begin(), cell.end(), ',');
  const auto points = std::count(cell.begin(), cell.end(), '.');
  if (commas == 0 && points <= 1) {
    if (points == 0 || !number_in(cell, '.')) return;
    ++votes.point;
    if (!number_in(cell, ',')) return;
    ++votes.grouped_points;
    if (votes.grouped_line == 0) votes.grouped_line = line;
    return;
  }
  if (commas == 1 && points == 0 && number_in(cell, ',')) {
    const auto behind = cell.substr(cell.find(',') + 1);
    const bool thousands = behind.size() == 3 && behind.find_first_of("eE") == behind.npos &&
                           cell.find(',') <= 4 && !cell.starts_with("0") && !cell.starts_with("-0");
    ++(thousands ? votes.either : votes.comma);
    if (thousands && votes.either_line == 0) votes.either_line = line;
  } else if (number_in(cell, ',')) {
    ++votes.comma;
    votes.both += commas == 1 && points > 0 ? 1 : 0;
  }
}

char find_decimal(const SourceText& text, const RawRows& rows) {
  DecimalVotes votes;
  for (std::size_t i = 0; i < rows.cells.size(); ++i)
    for (const auto cell : rows.cells[i]) vote(cell, rows.lines[i], votes);
  if (votes.comma > 0 && votes.grouped_points > 0 && votes.both == 0)
    fail(text, votes.grouped_line, "E-IMPORT-DECIMAL",
         "a point with three digits behind it may divide thousands or decimals: other numbers have "
         "a decimal comma",
         "if it divides thousands: --decimal comma; else write all numbers alike",
         "1.234 is 1.234 or 1234");
  if (votes.comma > 0) return ',';
  if (votes.either > 0 && votes.point == 0)
    fail(text, votes.either_line, "E-IMPORT-DECIMAL",
         "a comma with three digits behind it may divide thousands or decimals",
         "say which: --decimal comma, or --decimal point", "1,234 is 1.234 or 1234");
  return '.';
}

void add_comment(std::string_view line, RawRows& out) {
  for (const char* sign : kCommentSigns)
    if (line.starts_with(sign)) line = trimmed(line.substr(std::string_view(sign).size()));
  const auto colon = line.find(": ");
  if (colon == line.npos || colon == 0) return;
  out.comments.emplace_back(std::string(trimmed(line.substr(0, colon))),
                            std::string(trimmed(line.substr(colon + 2))));
}

/// If commas are decimal signs, every point must separate thousands: "1.234.567,8", not "0.125".
bool divides_thousands(std::string_view cell) {
  const auto first = cell.find('.');
  if (first == cell.npos) return true;
  const auto whole = cell.substr(0, std::min(cell.find(','), cell.find_first_of("eE")));
  if (whole.find('.') == whole.npos) return false;
  std::size_t digits = 0;
  for (std::size_t i = whole.size(); i-- > 0; ++digits) {
    if (whole[i] != '.') continue;
    if (digits != 3) return false;
    digits = static_cast<std::size_t>(-1);
  }
  const bool sign = whole.starts_with('-') || whole.starts_with('+');
  const auto lead = first - (sign ? 1 : 0);
  return lead >= 1 && lead <= 3 && whole[sign ? 1 : 0] != '0' &&
         cell.find('.', whole.size()) == cell.npos;
}

/// Removes the columns after the last named one if they are empty in every row.
void drop_empty_ends(const SourceText& text, RawRows& out) {
  auto& header = out.dialect.header;
  std::size_t named = header.size(), dropped = 0;
  while (named > 0 && header[named - 1].empty()) --named;
  const bool all_empty = std::all_of(out.cells.begin(), out.cells.end(), [&](const Cells& row) {
    return std::all_of(row.begin() + static_cast<std::ptrdiff_t>(std::min(named, row.size())),
                       row.end(), [](std::string_view cell) { return cell.empty(); });
  });
  if (!all_empty || named == 0) return;
  dropped = header.size() - named;
  header.resize(named);
  if (out.dialect.units.size() > named) out.dialect.units.resize(named);
  for (auto& row : out.cells) {
    if (row.size() <= named) continue;
    dropped = std::max(dropped, row.size() - named);
    row.resize(named);
  }
  if (dropped == 0) return;
  out.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-IMPORT-EMPTY",
       .message = fmt::format("the lines end with {} that hold nothing in any row: left out",
                              dropped == 1 ? "a separator" : fmt::format("{} cells", dropped)),
       .place = Place{.file = text.file, .line = std::max(1, out.dialect.header_line)},
       .help = "nothing is lost"});
}

}  // namespace

std::optional<double> number_in(std::string_view cell, char decimal) {
  cell = trimmed(cell);
  if (decimal == ',' && !divides_thousands(cell)) return std::nullopt;
  std::string copy;
  copy.reserve(cell.size());
  for (char c : cell) {
    if (c == decimal)
      copy += '.';
    else if (decimal == ',' && c == '.')
      continue;  // thousands
    else if (decimal == '.' && c == ',')
      return std::nullopt;
    else
      copy += c;
  }
  if (copy.starts_with('+')) copy.erase(0, 1);
  if (copy.empty() ||
      !(std::isdigit(static_cast<unsigned char>(copy.back())) || copy.back() == '.'))
    return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(copy.data(), copy.data() + copy.size(), value);
  if (error != std::errc{} || end != copy.data() + copy.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

RawRows cut(const SourceText& text, const DialectWishes& wishes) {
  RawRows out;
  Dialect& d = out.dialect;
  d.separator = wishes.separator ? *wishes.separator : find_separator(text);
  std::size_t first = 0;
  find_header(text, wishes, d, first);
  const int skipped = d.header_line > 0 ? d.header_line - 1 : 0;
  int prose = 0;
  for (int i = 0; i < skipped; ++i) {
    const auto line = trimmed(text.lines[i]);
    if (is_comment(line))
      add_comment(line, out);
    else if (!line.empty())
      ++prose;
  }
  if (prose > 0)
    out.remarks.push_back({.severity = Severity::kNote,
                           .code = "N-IMPORT-PREAMBLE",
                           .message = fmt::format("{} lines above the header were skipped", prose),
                           .place = Place{.file = text.file, .line = 1},
                           .help = "see them: plumb import --preview"});
  const std::size_t begin = wishes.header.empty()
                                ? static_cast<std::size_t>(std::max(d.header_line, d.unit_line))
                                : first;
  for (std::size_t i = begin; i < text.lines.size(); ++i) {
    const auto line = trimmed(text.lines[i]);
    if (line.empty()) continue;
    if (is_comment(line)) {
      add_comment(line, out);
      continue;
    }
    out.cells.push_back(cut_line(text.lines[i], d.separator));
    out.lines.push_back(static_cast<int>(i) + 1);
  }
  drop_empty_ends(text, out);
  for (std::size_t i = 0; i < out.cells.size(); ++i)
    if (out.cells[i].size() != d.header.size())
      fail(
          text, out.lines[i], "E-IMPORT-RAGGED",
          fmt::format("this row has {} cells, the header {}", out.cells[i].size(), d.header.size()),
          "complete or delete the row; if the separator is wrong: --separator \";\"",
          "cells are missing or too many");
  if (out.cells.empty())
    fail(text, d.header_line, "E-IMPORT-ROWS", "the file has a header and no rows",
         "export the measurements again", "nothing follows");
  d.decimal = wishes.decimal ? *wishes.decimal : find_decimal(text, out);
  return out;
}

}  // namespace plumb::offline
