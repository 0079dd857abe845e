// SPDX-License-Identifier: Apache-2.0
#include "cell/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cell/column_names.hpp"
#include "cell/csv_bytes.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

/// So many rows of the same wrong length, and none of the right one: the header is wrong. Chosen.
constexpr std::size_t kRowsThatAgree = 3;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Its heading was reported (E-CSV-UNIT), so that its cells are kept as texts.
bool lacks_unit(const Column& column) {
  return column.quantity == Quantity::kText && !column.header.empty() &&
         !unitless_quantity(column.header);
}

/// The first text of a column that holds nothing else; empty if there is none, or a number.
std::string first_text(const Column& column, char separator) {
  std::string out;
  for (const std::string& cell : column.text) {
    double value = 0.0;
    const NumberFault fault = read_number(cell, separator, value);
    if (fault == NumberFault::kEmpty) continue;
    if (fault != NumberFault::kNotANumber) return {};
    if (out.empty()) out = cell;
  }
  return out;
}

/// The heading is a slip for the name of a column of texts: "psoe".
bool names_texts(const Column& column) {
  const auto meant = misspelt_header(column.header);
  return meant && unitless_quantity(*meant) == Quantity::kText;
}

/// Turns the problem of a heading without unit into that of a column of texts.
void holds_texts(const Column& column, const std::string& text, bool has_note, Problem& problem) {
  problem.code = "E-CSV-TEXT";
  problem.message = fmt::format("column '{}' holds texts such as '{}', which plumb does not read",
                                column.header, text);
  problem.place->label = "no numbers";
  problem.help = has_note ? "remove it, or move its texts to the column 'note'"
                          : "remove it, or rename it to 'note': a column of that name may hold any "
                            "text";
}

}  // namespace

TableReader::TableReader(std::string file) { table_.file = std::move(file); }

TableReader TableReader::below(int first_line) const {
  TableReader out(table_.file);
  out.table_.comments = table_.comments;
  out.table_.raw_header = table_.raw_header;
  out.table_.header_line = table_.header_line;
  for (const auto& column : table_.columns)
    out.table_.columns.push_back({.header = column.header,
                                  .name = column.name,
                                  .unit = column.unit,
                                  .quantity = column.quantity,
                                  .values = {},
                                  .text = {}});
  out.units_ = units_;
  out.separator_ = separator_;
  out.semicolon_ = semicolon_;
  out.line_number_ = first_line - 1;
  return out;
}

void TableReader::expect(std::size_t rows, std::size_t bytes) {
  expected_rows_ = rows;
  expected_bytes_ = bytes;
  if (has_header()) reserve();
}

void TableReader::read(std::string_view lines) {
  check_bytes(lines, table_.file, line_number_ + 1);
  if (line_number_ == 0 && lines.starts_with(kByteOrderMark))
    lines.remove_prefix(kByteOrderMark.size());
  for (std::size_t at = 0; at < lines.size() && !problems_.full();) {
    const auto end = std::min(lines.find('\n', at), lines.size());
    read_line(lines.substr(at, end - at));
    at = end + 1;
  }
}

std::optional<Problem> TableReader::separator_note(bool decimal_comma) const {
  if (separator_ != ';') return std::nullopt;
  return Problem{.severity = Severity::kNote,
                 .code = "N-CSV-SEMICOLON",
                 .message = fmt::format("read with ';' between columns and decimal {}",
                                        decimal_comma ? "commas" : "points"),
                 .place = semicolon_};
}

Table TableReader::take() {
  table_.raw_rows = KeptRows(std::move(kept_), std::move(begins_), std::move(sizes_));
  table_.remarks = std::move(problems_.remarks());
  return std::move(table_);
}

void TableReader::read_line(std::string_view line) {
  ++line_number_;
  if (line.ends_with('\r')) line.remove_suffix(1);
  const auto content = trimmed(line);
  if (content.empty()) return;
  if (content.starts_with('#') || content.starts_with("//")) return read_comment(content);
  if (!table_.columns.empty()) return read_row(line);
  read_header_line(line);
}

void TableReader::read_comment(std::string_view line) {
  line.remove_prefix(line.starts_with('#') ? 1 : 2);
  const auto colon = line.find(':');
  if (colon == std::string_view::npos) return;
  table_.comments.emplace_back(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
}

void TableReader::read_header_line(std::string_view line) {
  table_.header_line = line_number_;
  separator_ = find_separator(line);
  if (separator_ == '\t') {
    problems_.error("E-CSV-SEPARATOR", "the columns are separated by tabs", here(line).of(line, ""),
                    fmt::format("plumb import {}", table_.file));
    problems_.stop_on_errors();
  }
  if (separator_ == ';') semicolon_ = here(line).of(line.substr(line.find(';'), 1), "separator");
  if (!cut(line)) return;
  const CsvPlace place = here(line);
  table_.columns = read_header(cells_, place, problems_);
  for (const auto& column : table_.columns) units_.push_back(unit_of(column.unit).value_or(Unit{}));
  append_canonical(line);
  table_.raw_header = kept_;
  kept_.clear();
  reserve();
}

void TableReader::reserve() {
  for (auto& column : table_.columns)
    if (column.quantity == Quantity::kText)
      column.text.reserve(expected_rows_);
    else
      column.values.reserve(expected_rows_);
  table_.lines.reserve(expected_rows_);
  begins_.reserve(expected_rows_);
  sizes_.reserve(expected_rows_);
  kept_.reserve(expected_bytes_);
}

/// False if the line's quotes are wrong.
bool TableReader::cut(std::string_view line) {
  const CsvFault fault = cut_line(line, separator_, cells_);
  if (fault == CsvFault::kNone) return true;
  const bool open = fault == CsvFault::kQuoteNotClosed;
  problems_.error("E-CSV-QUOTE",
                  open ? "a quote is not closed on its line" : "text behind a closing quote",
                  here(line).of(cells_.back().text, open ? "opened here" : "not expected"),
                  "a quote inside a quoted text is written twice: \"\"");
  return false;
}

void TableReader::read_row(std::string_view line) {
  if (!cut(line)) return;
  const std::size_t wanted = table_.columns.size();
  if (cells_.size() != wanted) return ragged(line);
  for (std::size_t i = 0; i < wanted; ++i) read_cell(i, line);
  table_.lines.push_back(line_number_);
  begins_.push_back(kept_.size());
  append_canonical(line);
  sizes_.push_back(kept_.size() - begins_.back());
}

void TableReader::ragged(std::string_view line) {
  const std::size_t wanted = table_.columns.size();
  const bool few = cells_.size() < wanted;
  problems_.error(
      "E-CSV-RAGGED", fmt::format("{} cells where the header has {}", cells_.size(), wanted),
      here(line).of(few ? line.substr(line.size()) : cells_[wanted].text,
                    few ? fmt::format("'{}' is missing", table_.columns[cells_.size()].header)
                        : "one too many"),
      "complete or delete this row");
}

void TableReader::read_cell(std::size_t i, std::string_view line) {
  Column& column = table_.columns[i];
  if (column.quantity == Quantity::kText) {
    column.text.push_back(text_of(cells_[i]));
    if (column.name == "pose" && column.text.back().empty()) bad_cell(i, line, NumberFault::kEmpty);
    return;
  }
  double value = 0.0;
  if (separator_ == ';') commas_ = commas_ || cells_[i].text.find(',') != std::string_view::npos;
  NumberFault fault = read_number(cells_[i].text, separator_, value);
  value = units_[i].to_si(value);
  if (fault == NumberFault::kNone && !std::isfinite(value)) fault = NumberFault::kOutOfRange;
  if (fault != NumberFault::kNone) bad_cell(i, line, fault);
  column.values.push_back(value);
}

void TableReader::bad_cell(std::size_t i, std::string_view line, NumberFault fault) {
  const auto& header = table_.columns[i].header;
  const auto cell = cells_[i].text;
  const auto report = [&](const char* code, std::string message, const char* label) {
    problems_.error(code, std::move(message), here(line).of(cell, label),
                    "correct it, or delete the row");
  };
  if (fault == NumberFault::kEmpty)
    report("E-CSV-MISSING", fmt::format("column '{}' has an empty cell", header), "no value");
  else if (fault == NumberFault::kOutOfRange)
    report("E-CSV-RANGE", fmt::format("column '{}': '{}' does not fit a number", header, cell),
           "too large or too small");
  else if (fault == NumberFault::kNotFinite)
    report("E-CSV-NAN", fmt::format("column '{}' holds '{}'", header, cell), "not a finite number");
  else
    report("E-CSV-NUMBER", fmt::format("column '{}': '{}' is not a number", header, cell),
           "not a number");
}

void TableReader::check_texts() {
  auto problem = problems_.errors().begin();
  bool has_note = table_.find("note") != nullptr;
  for (const Column& column : table_.columns) {
    if (!lacks_unit(column)) continue;
    problem = std::find_if(problem, problems_.errors().end(),
                           [](const Problem& p) { return p.code == "E-CSV-UNIT"; });
    if (problem == problems_.errors().end()) return;
    const std::string text = first_text(column, separator_);
    if (!text.empty() && !names_texts(column))
      holds_texts(column, text, std::exchange(has_note, true), *problem);
    ++problem;
  }
}

void TableReader::blame_header() {
  auto& errors = problems_.errors();
  if (!table_.lines.empty() || errors.size() < kRowsThatAgree) return;
  const bool alike = std::all_of(errors.begin(), errors.end(), [&](const Problem& p) {
    return p.code == "E-CSV-RAGGED" && p.message == errors.front().message;
  });
  if (!alike) return;
  Problem one = std::move(errors.front());
  one.message = "every row has " + one.message;
  one.place = Place{.file = table_.file,
                    .line = table_.header_line,
                    .column = 1,
                    .length = static_cast<int>(table_.raw_header.size()),
                    .source = table_.raw_header,
                    .label = fmt::format("{} names", table_.columns.size())};
  one.help = "complete the header, or delete the name of the column that is missing";
  errors.assign(1, std::move(one));
}

void TableReader::check_content() {
  blame_header();
  check_texts();
  const Place whole{.file = table_.file};
  if (!problems_.errors().empty()) return;
  if (table_.columns.empty())
    problems_.error("E-CSV-EMPTY", "the file has no header", whole,
                    "export the measurements again");
  else if (table_.lines.empty())
    problems_.error("E-CSV-ROWS", "the file has a header but no rows", whole,
                    "export the measurements again");
}

/// Appends the line to what is kept, with commas between columns and decimal points.
void TableReader::append_canonical(std::string_view line) {
  if (separator_ == ',') {
    kept_ += line;
    return;
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (i > 0) kept_ += ',';
    const std::size_t begin = kept_.size();
    const bool is_text = table_.columns[i].quantity == Quantity::kText;
    if (is_text || table_.header_line == line_number_)
      kept_ += quoted_if_needed(text_of(cells_[i]));
    else
      kept_ += cells_[i].text;
    if (!is_text) std::replace(kept_.begin() + static_cast<long>(begin), kept_.end(), ',', '.');
  }
}

}  // namespace plumb::offline
