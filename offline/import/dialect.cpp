// SPDX-License-Identifier: Apache-2.0
#include "import/dialect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "import/cell_units.hpp"
#include "import/cells.hpp"
#include "import/controller_program.hpp"
#include "import/decimal_sign.hpp"
#include "import/headerless.hpp"
#include "import/joint_states.hpp"
#include "import/key_values.hpp"
#include "import/other_lines.hpp"
#include "import/unit_words.hpp"
#include "import/vector_cells.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kLookedLines = 200;
constexpr std::size_t kMostFaults = 1000;
/// Share of the cells of a row from which on it is a row of numbers.
constexpr double kMostlyNumbers = 0.5;

std::vector<std::string_view> sample(const SourceText& text) {
  std::vector<std::string_view> out;
  for (const auto line : text.lines)
    if (!trimmed(line).empty() && !is_comment(trimmed(line)) && out.size() < kLookedLines)
      out.push_back(line);
  return out;
}

/// The separator with the largest sum of two shares: of the lines that it cuts into the most common
/// number of cells, which must be two or more, and of the cells that are numbers.
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

void add_comment(std::string_view line, RawRows& out) {
  line = without_comment_sign(line);
  const auto colon = line.find(": ");
  if (colon == line.npos || colon == 0) return;
  out.comments.emplace_back(std::string(trimmed(line.substr(0, colon))),
                            std::string(trimmed(line.substr(colon + 2))));
}

/// Removes the columns after the last named one if they are empty in every row.
void drop_empty_ends(const SourceText& text, RawRows& out) {
  auto& header = out.dialect.header;
  std::size_t named = header.size(), dropped = 0;
  while (named > 0 && header[named - 1].empty()) --named;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < out.cells.size(); ++i) {
    const CellRow row = out.cells[i];
    for (std::size_t k = named; k < row.size(); ++k)
      if (!row[k].empty()) return;
    longest = std::max(longest, row.size());
  }
  if (named == 0) return;
  dropped = header.size() - named;
  header.resize(named);
  if (out.dialect.units.size() > named) out.dialect.units.resize(named);
  if (longest > named) {
    dropped = std::max(dropped, longest - named);
    out.cells.shorten_rows(named);
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

/// The cells of a row; a vector between brackets is one of them.
Cells row_cells(std::string_view line, char separator) {
  const bool vectors =
      separator != ' ' && line.find('[') != line.npos &&
      std::count(line.begin(), line.end(), '[') == std::count(line.begin(), line.end(), ']');
  return cut_line(line, separator, vectors ? Brackets::kKeptWhole : Brackets::kCut);
}

/// Finds the line above the numbers that names the columns.
class HeaderSearch {
 public:
  HeaderSearch(const SourceText& text, char separator) : text_(text), separator_(separator) {
    wanted_ = usual_size();
    while (data_ < text.lines.size() && !(is_data(data_) && size_of(data_) == wanted_)) ++data_;
  }

  /// The first line of numbers, its number of cells, and whether there is any.
  std::size_t data() const { return data_; }
  std::size_t wanted() const { return wanted_; }
  bool has_data() const { return data_ < text_.lines.size(); }

  /// Sets header and units; false if no line above the numbers holds names.
  bool find(Dialect& d) const {
    const auto above = candidates();
    if (above.empty()) return false;
    const auto nearest = names_of(above[0]);
    const bool units = above.size() > 1 && are_units(nearest);
    d.header = units ? names_of(above[1]) : nearest;
    d.header_line = static_cast<int>(units ? above[1] : above[0]) + 1;
    if (units) d.units = nearest, d.unit_line = static_cast<int>(above[0]) + 1;
    if (!units && above.size() > 1 && are_units(names_of(above[1])))
      d.units = names_of(above[1]), d.unit_line = static_cast<int>(above[1]) + 1;
    return true;
  }

 private:
  std::size_t size_of(std::size_t i) const { return row_cells(text_.lines[i], separator_).size(); }

  bool is_data(std::size_t i) const {
    const auto line = trimmed(text_.lines[i]);
    if (line.empty() || is_comment(line)) return false;
    const Cells cells = row_cells(text_.lines[i], separator_);
    return cells.size() >= 2 && number_share(cells) >= kMostlyNumbers;
  }

  /// The number of cells that most rows have: lines above the table may hold numbers too.
  std::size_t usual_size() const {
    std::map<std::size_t, std::size_t> cells;  // in all lines with that many
    std::size_t looked = 0;
    for (std::size_t i = 0; i < text_.lines.size() && looked < kLookedLines; ++i)
      if (is_data(i)) cells[size_of(i)] += size_of(i), ++looked;
    std::size_t best = 2, most = 0;
    for (const auto& [size, count] : cells)
      if (count >= most) most = count, best = size;
    return best;
  }

  /// Lines that may be the header, nearest to the numbers first; two at most.
  std::vector<std::size_t> candidates() const {
    std::vector<std::size_t> out;
    for (const bool exactly : {true, false}) {
      for (std::size_t i = data_; i-- > 0 && out.size() < 2;)
        if (may_be_header(i, exactly && out.empty())) out.push_back(i);
      if (!out.empty()) return out;
    }
    return out;
  }

  bool may_be_header(std::size_t i, bool exactly) const {
    const auto line = trimmed(text_.lines[i]);
    if (line.empty() || states_something(line)) return false;
    const auto names = names_of(i);
    if (names.size() < std::min(wanted_, std::size_t{2})) return false;
    if (!has_data()) return true;
    const bool rows_above = number_share(Cells(names.begin(), names.end())) >= kMostlyNumbers;
    const bool words = std::any_of(line.begin(), line.end(), [](unsigned char c) {
      return std::isalpha(c) != 0 || c >= 0x80;
    });
    return !rows_above && words && (exactly ? names.size() == wanted_ : 2 * names.size() > wanted_);
  }

  /// "# robot: UR10", "// Units: mm  Frame: world".
  static bool states_something(std::string_view line) {
    if (!is_comment(line)) return states_units(line) && line.find(':') != line.npos;
    const auto text = without_comment_sign(line);
    const auto colon = text.find(": ");
    return colon != text.npos && colon > 0;
  }

  std::vector<std::string> names_of(std::size_t i) const {
    // Not trimmed unless it is a comment: a tab at the beginning ends an empty first cell.
    std::string_view line = text_.lines[i];
    if (const auto comment = trimmed(line); is_comment(comment))
      line = without_comment_sign(comment);
    Cells cells = cut_line(line, separator_);
    if (cells.size() != wanted_) {
      Cells whole = cut_line(line, separator_, Brackets::kKeptWhole);
      if (whole.size() == wanted_) cells = std::move(whole);
    }
    return {cells.begin(), cells.end()};
  }

  /// "name" over "mm" over numbers: the nearer of the two lines is the row of units.
  static bool are_units(const std::vector<std::string>& cells) {
    const auto known = [](const std::string& cell) { return !known_unit(cell).empty(); };
    return std::any_of(cells.begin(), cells.end(), known) &&
           std::all_of(cells.begin(), cells.end(), [&](const std::string& cell) {
             return cell.empty() || cell == "-" || cell == "[-]" || known(cell) ||
                    !unit_of_others(cell).empty();
           });
  }

  const SourceText& text_;
  char separator_;
  std::size_t wanted_ = 2, data_ = 0;
};

/// The first line that holds a row. A file without header gets the names that its rows tell, or
/// the question for them.
std::size_t find_header(const SourceText& text, const DialectWishes& wishes, RawRows& out) {
  Dialect& d = out.dialect;
  const HeaderSearch search(text, d.separator);
  if (!wishes.header.empty()) {
    d.header = wishes.header;
    return search.has_data() ? search.data() : 0;
  }
  if (search.find(d)) return static_cast<std::size_t>(std::max(d.header_line, d.unit_line));
  if (!search.has_data())
    fail(text, 1, "E-IMPORT-HEADER", "no row of numbers was found",
         "if the separator is unusual: --separator \"|\"");
  CellTable rows(text.texts);
  for (std::size_t i = search.data(); i < text.lines.size(); ++i)
    if (const Cells cells = row_cells(text.lines[i], d.separator); cells.size() == search.wanted())
      rows.add(cells);
  d.header = names_without_header(text, static_cast<int>(search.data()) + 1, rows, out.remarks);
  return search.data();
}

void look_above(const SourceText& text, std::size_t first, RawRows& out) {
  std::vector<int> skipped;
  for (std::size_t i = 0; i < first; ++i) {
    const auto line = trimmed(text.lines[i]);
    const int number = static_cast<int>(i) + 1;
    if (number == out.dialect.header_line || number == out.dialect.unit_line) continue;
    read_stated_units(line, number, out.stated);
    if (is_comment(line))
      add_comment(line, out);
    else if (!line.empty())
      skipped.push_back(number);
  }
  if (skipped.empty()) return;
  out.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-IMPORT-PREAMBLE",
       .message = fmt::format("above the table, and skipped: {}", lines_in_words(skipped)),
       .place = Place{.file = text.file, .line = skipped.front()},
       .help = "see what was understood: plumb import --preview"});
}

void cut_rows(const SourceText& text, std::size_t first, RawRows& out) {
  const std::size_t lines = text.lines.size() - first;
  out.lines.reserve(lines);
  out.cells.expect(lines, lines * out.dialect.header.size());
  for (std::size_t i = first; i < text.lines.size(); ++i) {
    const auto line = trimmed(text.lines[i]);
    if (line.empty()) continue;
    if (is_comment(line)) {
      add_comment(line, out);
      continue;
    }
    out.cells.add(row_cells(text.lines[i], out.dialect.separator));
    out.lines.push_back(static_cast<int>(i) + 1);
  }
}

/// Takes the rows out that have too few cells or too many (E-IMPORT-RAGGED).
void set_ragged_aside(const SourceText& text, RawRows& rows) {
  const std::size_t names = rows.dialect.header.size();
  rows.keep_rows([&](std::size_t i) {
    const std::size_t cells = rows.cells[i].size();
    const int line = rows.lines[i];
    if (cells == names) return true;
    if (rows.faults.size() >= kMostFaults) return false;
    rows.faults.push_back(
        {.code = "E-IMPORT-RAGGED",
         .message = fmt::format("this row has {} cell{}, the header {}", cells,
                                cells == 1 ? "" : "s", names),
         .place = Place{.file = text.file,
                        .line = line,
                        .column = 1,
                        .source = std::string(text.lines[static_cast<std::size_t>(line) - 1]),
                        .label = "cells are missing or too many"},
         .help = "complete or delete the row; if the separator is wrong: --separator \";\""});
    return false;
  });
  if (rows.cells.empty() && !rows.faults.empty()) throw Failure(Exit::kInput, rows.faults);
}

void refuse_other_formats(const SourceText& text) {
  const auto first = std::find_if(text.lines.begin(), text.lines.end(),
                                  [](std::string_view line) { return !trimmed(line).empty(); });
  if (first == text.lines.end()) return;
  if (const auto format = other_format(trimmed(*first)); !format.empty())
    fail(text, 1, "E-IMPORT-FORMAT", fmt::format("this is {}, no table", format),
         "export a table as text (CSV), one row a pose");
}

}  // namespace

RawRows cut(const SourceText& text, const DialectWishes& wishes) {
  if (auto program = controller_program(text)) {
    set_ragged_aside(text, *program);
    return std::move(*program);
  }
  RawRows out(text);
  Dialect& d = out.dialect;
  const bool stated = wishes.separator || !wishes.header.empty();
  if (auto pairs = stated ? std::nullopt : key_values(text)) {
    out = std::move(*pairs);
  } else {
    if (!stated) refuse_other_formats(text);
    d.separator = wishes.separator ? *wishes.separator : find_separator(text);
    const std::size_t first = find_header(text, wishes, out);
    look_above(text, first, out);
    cut_rows(text, first, out);
  }
  drop_empty_ends(text, out);
  leave_out_other_lines(text, out);
  set_ragged_aside(text, out);
  if (out.cells.empty())
    fail(text, d.header_line, "E-IMPORT-ROWS", "the file has a header and no rows",
         "export the measurements again", "nothing follows");
  name_joint_states(text, out);
  expand_vectors(text, out);
  d.decimal = wishes.decimal ? *wishes.decimal : find_decimal(text, out);
  take_units_from_cells(text, out);
  return out;
}

}  // namespace plumb::offline
