// SPDX-License-Identifier: Apache-2.0
#include "cell/measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "cell/file.hpp"
#include "cell/units.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kMostProblems = 1000;

const std::set<std::string_view> kTextColumns{"pose",  "set",    "note", "time",
                                              "joint", "status", "type"};
const std::set<std::string_view> kPlainNumbers{"repeat", "fold", "qw",  "qx",  "qy",  "qz",  "pqw",
                                               "pqx",    "pqy",  "pqz", "cqw", "cqx", "cqy", "cqz"};

bool is_direction(std::string_view name) {
  return name.starts_with("dir_j") && name.size() > 5 &&
         name.find_first_not_of("0123456789", 5) == std::string_view::npos;
}

bool is_plain(std::string_view name) {
  return kTextColumns.contains(name) || kPlainNumbers.contains(name) || is_direction(name);
}

std::string_view trimmed(std::string_view s) {
  const auto first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

/// One line cut at separators; quotes protect them.
void cut(std::string_view line, char separator, std::vector<std::string_view>& out) {
  out.clear();
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i == line.size() || (line[i] == separator && !quoted)) {
      out.push_back(line.substr(begin, i - begin));
      begin = i + 1;
    }
  }
}

std::string unquoted(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = cell.substr(1, cell.size() - 2);
  return std::string(cell);
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : text_(text) { table_.file = file; }

  Table read() {
    check_bytes();
    for (std::size_t at = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0; at < text_.size();) {
      const auto end = std::min(text_.find('\n', at), text_.size());
      read_line(text_.substr(at, end - at));
      at = end + 1;
    }
    if (problems_.empty()) check_content();
    if (!problems_.empty()) throw Failure(Exit::kInput, std::move(problems_));
    return std::move(table_);
  }

 private:
  void check_bytes() {
    if (text_.empty())
      throw Failure(Exit::kInput, problem("E-CSV-EMPTY", "the file is empty", {},
                                          "export the measurements again"));
    if (text_.find('\0') != std::string_view::npos)
      throw Failure(Exit::kInput,
                    problem("E-CSV-BINARY", "this is not a text file: it holds zero bytes", {},
                            "save it as CSV, UTF-8"));
  }

  void read_line(std::string_view line) {
    ++line_number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    const auto content = trimmed(line);
    if (content.empty()) return;
    if (content.starts_with('#') || content.starts_with("//")) return read_comment(content);
    if (table_.columns.empty()) return read_header(line);
    read_row(line);
  }

  void read_comment(std::string_view line) {
    line.remove_prefix(line.starts_with('#') ? 1 : 2);
    const auto colon = line.find(':');
    if (colon == std::string_view::npos) return;
    table_.comments.emplace_back(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
  }

  void read_header(std::string_view line) {
    separator_ = line.find(';') != std::string_view::npos ? ';' : ',';
    if (separator_ == ';')
      table_.remarks.push_back(problem("N-CSV-SEMICOLON",
                                       "read with ';' between columns and decimal commas", {}, "",
                                       Severity::kNote));
    cut(line, separator_, cells_);
    for (const auto cell : cells_) add_column(line, cell);
    table_.raw_header = joined();
  }

  void add_column(std::string_view line, std::string_view cell) {
    Column column;
    column.header = unquoted(cell);
    const Place place = place_of(line, cell);
    if (column.header.empty())
      add(problem("E-CSV-HEADER", "a column has no name", with(place, "name it"),
                  "give every column a name"));
    for (const auto& other : table_.columns)
      if (other.header == column.header)
        add(problem("E-CSV-DUPLICATE", fmt::format("column '{}' appears twice", column.header),
                    with(place, "second one"), "delete or rename one of them"));
    name_column(column, place);
    table_.columns.push_back(std::move(column));
    scales_.push_back(unit_of(table_.columns.back().unit).value_or(Unit{}));
  }

  void name_column(Column& column, const Place& place) {
    if (is_plain(column.header)) {
      column.name = column.header;
      column.quantity = kTextColumns.contains(column.name) ? Quantity::kText : Quantity::kNumber;
      return;
    }
    const Heading heading = split_heading(column.header);
    const auto unit = unit_of(heading.unit);
    column.name = heading.name;
    column.unit = heading.unit;
    if (unit) {
      column.quantity = unit->quantity;
    } else if (heading.unit.empty()) {
      add(problem("E-CSV-UNIT", fmt::format("column '{}' has no unit", column.header),
                  with(place, "add a unit suffix"),
                  fmt::format("rename it to '{0}_mm', or: plumb import {1} --map {0}={0}_mm",
                              column.header, table_.file)));
    } else {
      add(problem("E-CSV-UNIT",
                  fmt::format("column '{}': '{}' is not a unit", column.header, heading.unit),
                  with(place, "unknown unit"), "known units: " + unit_list()));
    }
  }

  void read_row(std::string_view line) {
    cut(line, separator_, cells_);
    if (cells_.size() != table_.columns.size()) {
      add(problem(
          "E-CSV-RAGGED",
          fmt::format("{} cells where the header has {}", cells_.size(), table_.columns.size()),
          with(place_of(line, line), ""), "complete or delete this row"));
      return;
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) read_cell(i, line);
    table_.lines.push_back(line_number_);
    table_.raw_rows.push_back(joined());
  }

  void read_cell(std::size_t i, std::string_view line) {
    Column& column = table_.columns[i];
    if (column.quantity == Quantity::kText) {
      column.text.push_back(unquoted(cells_[i]));
      return;
    }
    column.values.push_back(scales_[i].scale * number(i, line) + scales_[i].offset);
  }

  double number(std::size_t i, std::string_view line) {
    std::string_view cell = trimmed(cells_[i]);
    if (separator_ == ';' && cell.find(',') != std::string_view::npos) {
      decimal_.assign(cell);
      std::replace(decimal_.begin(), decimal_.end(), ',', '.');
      cell = decimal_;
    }
    if (cell.starts_with('+')) cell.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error == std::errc{} && end == cell.data() + cell.size() && std::isfinite(value))
      return value;
    bad_number(i, line, cell, error);
    return 0.0;
  }

  void bad_number(std::size_t i, std::string_view line, std::string_view cell, std::errc error) {
    const auto& header = table_.columns[i].header;
    const Place place = place_of(line, trimmed(cells_[i]).empty() ? cells_[i] : trimmed(cells_[i]));
    const std::string help = "measure this pose again, or delete the row";
    if (cell.empty())
      add(problem("E-CSV-MISSING", fmt::format("column '{}' has an empty cell", header),
                  with(place, "no value"), help));
    else if (error == std::errc::result_out_of_range)
      add(problem("E-CSV-RANGE",
                  fmt::format("column '{}': '{}' is beyond any number", header, cell),
                  with(place, "too large or too small"), help));
    else if (cell == "nan" || cell == "NaN" || cell == "NAN" || cell == "inf" || cell == "-inf")
      add(problem("E-CSV-NAN", fmt::format("column '{}' holds '{}'", header, cell),
                  with(place, "not a finite number"), help));
    else
      add(problem("E-CSV-NUMBER", fmt::format("column '{}': '{}' is not a number", header, cell),
                  with(place, "not a number"), help));
  }

  void check_content() {
    if (table_.columns.empty())
      add(problem("E-CSV-EMPTY", "the file has no header", {}, "export the measurements again"));
    else if (table_.lines.empty())
      add(problem("E-CSV-ROWS", "the file has a header but no rows", {},
                  "export the measurements again"));
  }

  /// The cells of the present line as canonical CSV.
  std::string joined() const {
    std::string out;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (i > 0) out += ',';
      std::string cell(trimmed(cells_[i]));
      if (separator_ == ';') {
        if (i < table_.columns.size() && table_.columns[i].quantity != Quantity::kText)
          std::replace(cell.begin(), cell.end(), ',', '.');
        else if (cell.find(',') != std::string::npos && !cell.starts_with('"'))
          cell = '"' + cell + '"';
      }
      out += cell;
    }
    return out;
  }

  Place place_of(std::string_view line, std::string_view cell) const {
    return {.file = table_.file,
            .line = line_number_,
            .column = static_cast<int>(cell.data() - line.data()) + 1,
            .length = static_cast<int>(std::max<std::size_t>(1, cell.size())),
            .source = std::string(line)};
  }
  static Place with(Place place, std::string label) {
    place.label = std::move(label);
    return place;
  }
  Problem problem(std::string code, std::string message, std::optional<Place> place,
                  std::string help, Severity severity = Severity::kError) const {
    if (!place) place = Place{.file = table_.file};
    return {severity, std::move(code), std::move(message), std::move(place), std::move(help)};
  }
  void add(Problem p) {
    if (problems_.size() < kMostProblems) problems_.push_back(std::move(p));
  }

  std::string_view text_;
  Table table_;
  std::vector<Problem> problems_;
  std::vector<std::string_view> cells_;
  std::vector<Unit> scales_;
  std::string decimal_;
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
  Table table = Reader(text, file_name).read();
  table.sha256 = sha256(text);
  return table;
}

Table read_table(const std::filesystem::path& file) {
  return parse_table(read_file(file), file.string());
}

}  // namespace plumb::offline
