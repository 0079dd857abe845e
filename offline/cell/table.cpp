// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cell/csv_header.hpp"
#include "cell/file.hpp"
#include "cell/units.hpp"
#include "cell/utf8.hpp"

namespace plumb::offline {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

class TableReader {
 public:
  TableReader(std::string_view text, const std::string& file) : text_(text) { table_.file = file; }

  Table read() {
    check_bytes();
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
    for (std::size_t at = 0; at < text_.size() && !problems_.full();) {
      const auto end = std::min(text_.find('\n', at), text_.size());
      read_line(text_.substr(at, end - at));
      at = end + 1;
    }
    check_content();
    problems_.stop_on_errors();
    table_.raw_rows = KeptRows(std::move(kept_), std::move(begins_), std::move(sizes_));
    table_.remarks = std::move(problems_.remarks());
    return std::move(table_);
  }

 private:
  [[noreturn]] void refuse(std::string code, std::string message, Place place, std::string help) {
    place.file = table_.file;
    throw Failure(Exit::kInput,
                  Problem{.code = code, .message = message, .place = place, .help = help});
  }

  void check_bytes() {
    if (text_.empty())
      refuse("E-CSV-EMPTY", "the file is empty", {}, "export the measurements again");
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))
      refuse("E-CSV-UTF8", "the file is UTF-16, not UTF-8", {},
             fmt::format("iconv -f UTF-16 -t UTF-8 {0} > utf8.csv", table_.file));
    if (const auto zero = text_.find('\0'); zero != std::string_view::npos)
      refuse("E-CSV-BINARY", "this is no text file: it holds zero bytes", place_at(zero),
             "save the measurements as CSV in UTF-8");
    if (const auto bad = find_invalid_utf8(text_); bad != std::string_view::npos)
      refuse("E-CSV-UTF8", "this byte is not UTF-8", place_at(bad),
             fmt::format("iconv -f WINDOWS-1252 -t UTF-8 {0} > utf8.csv", table_.file));
  }

  Place place_at(std::size_t offset) const {
    const auto before = text_.substr(0, offset);
    const auto newline = before.rfind('\n');
    const auto begin = newline == std::string_view::npos ? 0 : newline + 1;
    const auto line = text_.substr(begin, text_.find('\n', offset) - begin);
    const int number = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
    return CsvPlace{table_.file, number, line}.of(text_.substr(offset, 1), "here");
  }

  void read_line(std::string_view line) {
    ++line_number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    const auto content = trimmed(line);
    if (content.empty()) return;
    if (content.starts_with('#') || content.starts_with("//")) return read_comment(content);
    if (!table_.columns.empty()) return read_row(line);
    read_header_line(line);
  }

  void read_comment(std::string_view line) {
    line.remove_prefix(line.starts_with('#') ? 1 : 2);
    const auto colon = line.find(':');
    if (colon == std::string_view::npos) return;
    table_.comments.emplace_back(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
  }

  void read_header_line(std::string_view line) {
    table_.header_line = line_number_;
    separator_ = find_separator(line);
    if (separator_ == '\t')
      refuse("E-CSV-SEPARATOR", "the columns are separated by tabs", here(line).of(line, ""),
             fmt::format("plumb import {}", table_.file));
    if (separator_ == ';')
      problems_.note("N-CSV-SEMICOLON", "read with ';' between columns and decimal commas",
                     here(line).of(line.substr(line.find(';'), 1), "separator"), "");
    if (!cut(line)) return;
    const CsvPlace place = here(line);
    table_.columns = read_header(cells_, place, problems_);
    for (const auto& column : table_.columns)
      units_.push_back(unit_of(column.unit).value_or(Unit{}));
    reserve();
    append_canonical(line);
    table_.raw_header = kept_;
    kept_.clear();
  }

  void reserve() {
    const auto lines = static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '\n')) + 1;
    for (auto& column : table_.columns)
      if (column.quantity == Quantity::kText)
        column.text.reserve(lines);
      else
        column.values.reserve(lines);
    table_.lines.reserve(lines);
    begins_.reserve(lines);
    sizes_.reserve(lines);
    kept_.reserve(text_.size());
  }

  /// False if the line's quotes are wrong.
  bool cut(std::string_view line) {
    const CsvFault fault = cut_line(line, separator_, cells_);
    if (fault == CsvFault::kNone) return true;
    const bool open = fault == CsvFault::kQuoteNotClosed;
    problems_.error("E-CSV-QUOTE",
                    open ? "a quote is not closed on its line" : "text behind a closing quote",
                    here(line).of(cells_.back().text, open ? "opened here" : "not expected"),
                    "a quote inside a quoted text is written twice: \"\"");
    return false;
  }

  void read_row(std::string_view line) {
    if (!cut(line)) return;
    const std::size_t wanted = table_.columns.size();
    if (cells_.size() != wanted) return ragged(line);
    for (std::size_t i = 0; i < wanted; ++i) read_cell(i, line);
    table_.lines.push_back(line_number_);
    begins_.push_back(kept_.size());
    append_canonical(line);
    sizes_.push_back(kept_.size() - begins_.back());
  }

  void ragged(std::string_view line) {
    const std::size_t wanted = table_.columns.size();
    const bool few = cells_.size() < wanted;
    problems_.error(
        "E-CSV-RAGGED", fmt::format("{} cells where the header has {}", cells_.size(), wanted),
        here(line).of(few ? line.substr(line.size()) : cells_[wanted].text,
                      few ? fmt::format("'{}' is missing", table_.columns[cells_.size()].header)
                          : "one too many"),
        "complete or delete this row");
  }

  void read_cell(std::size_t i, std::string_view line) {
    Column& column = table_.columns[i];
    if (column.quantity != Quantity::kText) {
      column.values.push_back(units_[i].to_si(number(i, line)));
      if (!std::isfinite(column.values.back())) bad_number(i, line, std::errc::result_out_of_range);
      return;
    }
    column.text.push_back(text_of(cells_[i]));
    if (column.text.back().empty() && column.name == "pose")
      bad_number(i, line, std::errc::invalid_argument);
  }

  double number(std::size_t i, std::string_view line) {
    std::string_view cell = cells_[i].text;
    if (separator_ == ';' && cell.find(',') != std::string_view::npos) {
      decimal_.assign(cell);
      std::replace(decimal_.begin(), decimal_.end(), ',', '.');
      cell = decimal_;
    }
    if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
    double value = 0.0;
    const char* end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (error == std::errc{} && stop == end && std::isfinite(value)) return value;
    const bool too_far = error == std::errc::result_out_of_range && stop == end;
    const bool endless = error == std::errc{} && stop == end;
    bad_number(i, line,
               too_far   ? std::errc::result_out_of_range
               : endless ? std::errc::argument_out_of_domain
                         : std::errc::invalid_argument);
    return 0.0;
  }

  void bad_number(std::size_t i, std::string_view line, std::errc error) {
    const auto& header = table_.columns[i].header;
    const auto cell = cells_[i].text;
    const auto report = [&](const char* code, std::string message, const char* label) {
      problems_.error(code, std::move(message), here(line).of(cell, label),
                      "correct it, or delete the row");
    };
    if (cell.empty())
      report("E-CSV-MISSING", fmt::format("column '{}' has an empty cell", header), "no value");
    else if (error == std::errc::result_out_of_range)
      report("E-CSV-RANGE", fmt::format("column '{}': '{}' does not fit a number", header, cell),
             "too large or too small");
    else if (error == std::errc::argument_out_of_domain)
      report("E-CSV-NAN", fmt::format("column '{}' holds '{}'", header, cell),
             "not a finite number");
    else
      report("E-CSV-NUMBER", fmt::format("column '{}': '{}' is not a number", header, cell),
             "not a number");
  }

  void check_content() {
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
  void append_canonical(std::string_view line) {
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

  CsvPlace here(std::string_view line) const { return {table_.file, line_number_, line}; }

  std::string_view text_;
  Table table_;
  ProblemList problems_;
  std::vector<CsvCell> cells_;
  std::vector<Unit> units_;
  std::string decimal_, kept_;
  std::vector<std::size_t> begins_, sizes_;
  char separator_ = ',';
  int line_number_ = 0;
};

}  // namespace

const Column* Table::find(std::string_view name) const {
  for (const auto& column : columns)
    if (column.name == name) return &column;
  return nullptr;
}

Table parse_table(std::string_view text, const std::string& file_name) {
  Table table = TableReader(text, file_name).read();
  table.sha256 = sha256(text);
  return table;
}

Table read_table(const std::filesystem::path& file) {
  return parse_table(read_file(file), display_name(file));
}

}  // namespace plumb::offline
