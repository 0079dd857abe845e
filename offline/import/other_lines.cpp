// SPDX-License-Identifier: Apache-2.0
#include "import/other_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "import/cells.hpp"
#include "import/number_text.hpp"
#include "import/words.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kShown = 10;

/// Words that no pose has for its name, as `folded` returns them.
constexpr auto kStatistics = std::to_array<std::string_view>({"mean",
                                                              "average",
                                                              "avg",
                                                              "meanvalue",
                                                              "std",
                                                              "stdev",
                                                              "stddev",
                                                              "stdeviation",
                                                              "standarddeviation",
                                                              "sigma",
                                                              "1sigma",
                                                              "2sigma",
                                                              "3sigma",
                                                              "rms",
                                                              "rmse",
                                                              "median",
                                                              "range",
                                                              "variance",
                                                              "var",
                                                              "sum",
                                                              "total",
                                                              "count",
                                                              "n",
                                                              "spread",
                                                              "mittelwert",
                                                              "mittel",
                                                              "durchschnitt",
                                                              "stabw",
                                                              "standardabweichung",
                                                              "spannweite",
                                                              "summe",
                                                              "anzahl",
                                                              "streuung",
                                                              "varianz",
                                                              "moyenne",
                                                              "ecarttype",
                                                              "somme",
                                                              "etendue",
                                                              "media",
                                                              "deviazionestandard",
                                                              "scartotipo",
                                                              "somma",
                                                              "mediana",
                                                              "mediane",
                                                              "promedio",
                                                              "desviacion",
                                                              "desvest",
                                                              "suma",
                                                              "rango",
                                                              "desviacionestandar",
                                                              "平均",
                                                              "平均值",
                                                              "标准差",
                                                              "標準偏差",
                                                              "合计"});
constexpr auto kExtremes = std::to_array<std::string_view>(
    {"min", "max", "minimum", "maximum", "minimo", "massimo", "maximo", "minwert", "maxwert",
     "最大值", "最小值", "最大", "最小"});

template <class Words>
bool is_one_of(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A cell that names a statistic, as a word; empty if there is none.
std::string label_of(const CellRow& row) {
  for (const auto cell : row) {
    const std::string word = is_number(cell) ? "" : folded(cell.substr(0, cell.find(':')));
    if (is_one_of(kStatistics, word) || is_one_of(kExtremes, word)) return word;
  }
  return {};
}

bool without_letters(std::string_view line) {
  return std::none_of(line.begin(), line.end(),
                      [](unsigned char c) { return std::isalnum(c) != 0 || c >= 0x80; });
}

bool holds_no_number(const CellRow& row) {
  return std::none_of(row.begin(), row.end(),
                      [](std::string_view cell) { return is_number(cell); });
}

bool equals(const CellRow& row, const std::vector<std::string>& names) {
  return row.size() == names.size() && std::equal(row.begin(), row.end(), names.begin());
}

/// The header or the row of units once more, or a line that holds no cell of a measurement.
bool stands_between(const SourceText& text, const RawRows& rows, std::size_t i) {
  const auto& d = rows.dialect;
  const CellRow row = rows.cells[i];
  if (std::all_of(row.begin(), row.end(), [](std::string_view c) { return c.empty(); }))
    return true;
  if (equals(row, d.header) || (!d.units.empty() && equals(row, d.units))) return true;
  if (without_letters(text.lines[rows.lines[i] - 1]) && holds_no_number(row))
    return row.size() != d.header.size() ||
           std::none_of(row.begin(), row.end(), [](std::string_view c) { return c.empty(); });
  return row.size() < d.header.size() && holds_no_number(row);
}

/// True if a row of extremes is what its name says: no row above lies beyond it.
bool is_extreme(const RawRows& rows, std::size_t i, bool largest) {
  bool any = false;
  for (std::size_t k = 0; k < rows.cells[i].size(); ++k) {
    const auto value = number_in(rows.cells[i][k], '.');
    if (!value) continue;
    any = true;
    for (std::size_t j = 0; j < i; ++j) {
      if (k >= rows.cells[j].size()) continue;
      const auto other = number_in(rows.cells[j][k], '.');
      if (other && (largest ? *other > *value : *other < *value)) return false;
    }
  }
  return any;
}

/// The first of the rows at the end that state something of the rows above them.
std::size_t begin_of_statistics(const RawRows& rows) {
  const std::size_t count = rows.cells.size();
  std::size_t first = count;
  bool sure = false;
  while (first > 0) {
    const std::string label = label_of(rows.cells[first - 1]);
    const bool extreme = is_one_of(kExtremes, label);
    if (!extreme && !is_one_of(kStatistics, label)) break;
    sure = sure || !extreme;
    --first;
  }
  if (sure || first == count) return first;
  for (std::size_t i = first; i < count; ++i)
    if (!is_extreme(rows, i, label_of(rows.cells[i]).find("ma") == 0)) return count;
  return first;
}

/// Lines at the end without the cells of a row, "24 points" or "Mean: 0.02": a sentence.
bool is_footer(const RawRows& rows, std::size_t i) {
  const CellRow row = rows.cells[i];
  return row.size() < rows.dialect.header.size() && !row.front().empty() &&
         number_share({row.begin(), row.end()}) < 0.5;
}

void note(const SourceText& text, const char* code, std::string message, int line, RawRows& rows) {
  rows.remarks.push_back({.severity = Severity::kNote,
                          .code = code,
                          .message = std::move(message),
                          .place = Place{.file = text.file, .line = line},
                          .help = "if one is a measurement, correct its line"});
}

}  // namespace

std::string lines_in_words(const std::vector<int>& lines) {
  if (lines.size() == 1) return fmt::format("line {}", lines.front());
  const bool run = lines.back() - lines.front() == static_cast<int>(lines.size()) - 1;
  if (run && lines.size() > 2) return fmt::format("lines {} to {}", lines.front(), lines.back());
  const std::vector<int> shown(
      lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, lines.size())));
  return fmt::format(
      "lines {}{}", fmt::join(shown, ", "),
      lines.size() > kShown ? fmt::format(" and {} more", lines.size() - kShown) : "");
}

void leave_out_other_lines(const SourceText& text, RawRows& rows) {
  std::vector<int> others, statistics;
  rows.keep_rows([&](std::size_t i) {
    if (!stands_between(text, rows, i)) return true;
    others.push_back(rows.lines[i]);
    return false;
  });
  std::size_t kept = rows.cells.size();
  while (kept > 0 && is_footer(rows, kept - 1) && begin_of_statistics(rows) == rows.cells.size()) {
    others.push_back(rows.lines[--kept]);
    rows.cells.truncate(kept);
  }
  const std::size_t first = begin_of_statistics(rows);
  for (std::size_t i = first; i < kept; ++i) statistics.push_back(rows.lines[i]);
  rows.cells.truncate(first);
  rows.lines.resize(first);
  std::sort(others.begin(), others.end());
  if (!others.empty())
    note(text, "N-IMPORT-LINES",
         fmt::format("no measurements, and left out: {}", lines_in_words(others)), others.front(),
         rows);
  if (!statistics.empty())
    note(text, "N-IMPORT-STATISTICS",
         fmt::format("the last rows are statistics of the others, and were left out: {}",
                     lines_in_words(statistics)),
         statistics.front(), rows);
}

}  // namespace plumb::offline
