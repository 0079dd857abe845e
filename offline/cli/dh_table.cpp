// SPDX-License-Identifier: Apache-2.0
#include "cli/dh_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "cell/csv_bytes.hpp"
#include "cell/csv_header.hpp"
#include "cell/csv_line.hpp"
#include "cell/units.hpp"
#include "cell/unmarked_utf16.hpp"
#include "cli/dh_heading.hpp"
#include "cli/dh_units.hpp"
#include "cli/dh_value.hpp"
#include "import/source_text.hpp"
#include "program/shell_word.hpp"
#include "program/utf8.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr const char* kDhExample =
    "write a table as CSV, a row a joint from base to tip: joint,alpha_deg,a_mm,d_mm,theta_deg";

bool is_dh_text(std::string_view name) { return name == "joint" || name == "type"; }

bool may_be_empty(std::string_view name) {
  return name == "q_min" || name == "q_max" || name == "offset";
}

/// The quantity of a column by its name alone.
Quantity usual_quantity(std::string_view name) {
  return name == "a" || name == "d" ? Quantity::kLength : Quantity::kAngle;
}

/// The name of a format that a line shows to be no table of columns, also of those that plumb
/// import reads; empty if it shows none.
std::string_view other_text(std::string_view line) {
  if (const auto format = other_format(line); !format.empty()) return format;
  if (line.starts_with("|")) return "a table in Markdown";
  if (line.starts_with("---") || line.starts_with("- ")) return "YAML";
  if (line.starts_with("["))
    return line.ends_with("]") && line.find(',') == line.npos ? "TOML" : "a list of numbers";
  const auto colon = line.find(':');
  const auto word = line.substr(0, colon);
  const bool key = colon != std::string_view::npos && !word.empty() &&
                   word.find_first_of(",;\t") == std::string_view::npos;
  if (key && (colon + 1 == line.size() || line[colon + 1] == ' ')) return "YAML";
  return line.find('=') != std::string_view::npos ? "a list of assignments" : "";
}

struct DhColumn {
  DhHeading heading;
  Quantity quantity = Quantity::kText;
  Place place;
  std::vector<std::optional<DhValue>> cells;  // of numbers; nothing: empty or faulty
};

class DhTableReader {
 public:
  DhTableReader(const std::string& file, ProblemList& problems) : problems_(problems) {
    table_.file = file;
  }

  Table read(std::string_view text) {
    for (std::size_t at = 0; at < text.size() && !problems_.full() && !no_table_;) {
      const auto end = std::min(text.find('\n', at), text.size());
      ++number_;
      read_line(text.substr(at, end - at));
      at = end + 1;
    }
    if (no_table_) return std::move(table_);
    const Place whole{.file = table_.file};
    if (table_.columns.empty())
      problems_.error("E-CSV-EMPTY", "the file has no header", whole, kDhExample);
    else if (table_.lines.empty() && problems_.errors().empty())
      problems_.error("E-CSV-ROWS", "the file has a header but no rows", whole, kDhExample);
    settle_units();
    check_variables();
    return std::move(table_);
  }

 private:
  CsvPlace here(std::string_view line) const { return {table_.file, number_, line}; }

  void read_line(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    const auto content = trimmed(line);
    if (content.empty() || content.starts_with("//")) return;
    const bool comment = content.starts_with("#") && !content.starts_with("#,") &&
                         !content.starts_with("#;") && !content.starts_with("#\t");
    if (comment) return;
    if (!table_.columns.empty()) return read_row(line);
    if (const auto other = other_text(content); !other.empty()) {
      no_table_ = true;
      return problems_.error("E-DH-FILE", fmt::format("this is {}, no table of columns", other),
                             here(line).of(content, ""), kDhExample);
    }
    read_header(line);
  }

  bool cut(std::string_view line) {
    const CsvFault fault = cut_line(line, separator_, cells_);
    if (fault == CsvFault::kNone) return true;
    problems_.error("E-CSV-QUOTE",
                    fault == CsvFault::kQuoteNotClosed ? "a quote is not closed on its line"
                                                       : "text behind a closing quote",
                    here(line).of(cells_.back().text, ""),
                    "a quote inside a quoted text is written twice: \"\"");
    return false;
  }

  void read_header(std::string_view line) {
    table_.header_line = number_;
    separator_ = find_separator(line);
    if (!cut(line)) {
      no_table_ = true;
      return;
    }
    const bool numbers = std::all_of(cells_.begin(), cells_.end(), [](const CsvCell& cell) {
      const auto value = read_dh_value(cell.text, false);
      return value && !value->variable;
    });
    if (numbers || cells_.size() == 1) {
      no_table_ = true;
      return problems_.error(
          numbers ? "E-CSV-HEADER" : "E-CSV-SEPARATOR",
          numbers ? "the first line holds numbers where the names of the columns belong"
                  : "the first line has one column: nothing separates the names",
          here(line).of(trimmed(line), ""), kDhExample);
    }
    for (const CsvCell& cell : cells_) add_column(line, cell);
  }

  void add_column(std::string_view line, const CsvCell& cell) {
    Column column;
    DhColumn more;
    column.header = text_of(cell);
    more.heading = read_dh_heading(column.header);
    more.place = here(line).of(cell.text, "");
    column.name = more.heading.name.empty() ? column.header : more.heading.name;
    column.unit = more.heading.unit;
    if (!more.heading.name.empty() && !is_dh_text(column.name)) {
      const auto unit = unit_of(column.unit);
      more.quantity = unit ? unit->quantity : usual_quantity(column.name);
    }
    column.quantity = more.quantity;
    if (column.header.empty())
      problems_.error("E-CSV-HEADER", "a column has no name", more.place,
                      "name it, or delete the column");
    else
      check_twin(column, more.place);
    table_.columns.push_back(std::move(column));
    columns_.push_back(std::move(more));
  }

  void check_twin(const Column& column, const Place& place) {
    for (const Column& other : table_.columns) {
      const bool two_kinds = may_be_empty(column.name) && other.quantity != column.quantity;
      if (other.name != column.name || two_kinds) continue;
      problems_.error("E-CSV-DUPLICATE",
                      other.header == column.header
                          ? fmt::format("column '{}' appears twice", column.header)
                          : fmt::format("columns '{}' and '{}' are the same quantity", other.header,
                                        column.header),
                      place, "delete or rename one of them");
    }
  }

  void read_row(std::string_view line) {
    if (!cut(line)) return;
    const std::size_t wanted = columns_.size();
    if (cells_.size() != wanted)
      return problems_.error("E-CSV-RAGGED",
                             fmt::format("{} cells where the header has {}", cells_.size(), wanted),
                             here(line).of(line.substr(line.size()), ""),
                             "complete this row: every row is a joint of the arm");
    table_.lines.push_back(number_);
    for (std::size_t k = 0; k < wanted; ++k)
      if (columns_[k].quantity == Quantity::kText)
        table_.columns[k].text.push_back(text_of(cells_[k]));
      else
        columns_[k].cells.push_back(read_cell(k, line));
  }

  /// The value of a cell; nothing if the cell is empty, or wrong, which is reported.
  std::optional<DhValue> read_cell(std::size_t k, std::string_view line) {
    const std::string& header = table_.columns[k].header;
    const std::string written = text_of(cells_[k]);
    const auto fault = [&](const char* code, std::string message, std::string help) {
      problems_.error(code, std::move(message), here(line).of(cells_[k].text, ""), std::move(help));
      return std::nullopt;
    };
    if (written.empty() && may_be_empty(columns_[k].heading.name)) return std::nullopt;
    if (written.empty())
      return fault("E-CSV-MISSING", fmt::format("column '{}' has an empty cell", header),
                   "write its value, 0 if it is zero: every row is a joint of the arm");
    const auto value = read_dh_value(written, separator_ != ',');
    if (!value)
      return fault("E-CSV-NUMBER",
                   fmt::format("column '{}': '{}' is not a number", header, written),
                   columns_[k].quantity == Quantity::kAngle
                       ? "write a number such as 90, or pi/2 in a column in rad"
                       : "write a number such as 118");
    if (value->variable && !variable_is_meant(k, *value))
      return fault("E-CSV-NUMBER",
                   fmt::format("column '{}': '{}' is no number, nor the variable of joint {}",
                               header, written, table_.rows()),
                   "in theta the variable of the joint that turns may stand, with what is added to "
                   "it; a joint that slides has the type prismatic, and a number in d");
    const std::string& unit = columns_[k].heading.unit;
    if (!unit.empty() && !value->unit.empty() && value->unit != unit)
      return fault("E-CSV-NUMBER",
                   fmt::format("column '{}': '{}' is in {}", header, written, value->unit),
                   instead(unit, *value));
    return value;
  }

  /// "write 90": the value in the column's own unit.
  static std::string instead(const std::string& unit, const DhValue& value) {
    const Unit own = *unit_of(unit), other = *unit_of(value.unit);
    if (own.quantity != other.quantity) return fmt::format("the column's values are in {}", unit);
    return fmt::format("write {} there, or correct the unit of the column",
                       show::shortest(own.from_si(other.to_si(value.value))));
  }

  /// The variable of the row's own joint, in the column where it belongs if the joint turns.
  bool variable_is_meant(std::size_t k, const DhValue& value) const {
    return columns_[k].heading.name == "theta" &&
           (value.of_joint == 0 || value.of_joint == table_.rows());
  }

  /// The variable of a joint that slides is added to d.
  void check_variables() {
    const Column* type = table_.find("type");
    for (const DhColumn& column : columns_)
      for (std::size_t i = 0; type != nullptr && i < column.cells.size(); ++i)
        if (column.cells[i] && column.cells[i]->variable && type->text[i] == "prismatic")
          problems_.error("E-DH-TYPE",
                          fmt::format("joint {} is prismatic, but its theta is a variable", i + 1),
                          Place{.file = table_.file, .line = table_.lines[i]},
                          "write revolute, or the angle of this joint that stays");
  }

  // ---- units, and with them the numbers in SI

  void settle_units() {
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (columns_[k].quantity != Quantity::kText) fill(k, unit_of_column(k));
  }

  /// Every number of that quantity whose unit nobody states.
  std::vector<double> unlabelled(Quantity quantity) const {
    std::vector<double> out;
    for (const DhColumn& column : columns_)
      if (column.quantity == quantity && column.heading.unit.empty())
        for (const auto& cell : column.cells)
          if (cell && cell->unit.empty()) out.push_back(cell->value);
    return out;
  }

  /// The unit that the heading or the cells of a column state. If neither does, it reports a
  /// problem that names the unit that the numbers look like.
  std::string unit_of_column(std::size_t k) {
    const DhColumn& column = columns_[k];
    if (!column.heading.unit.empty()) return column.heading.unit;
    std::string stated;
    bool all = column.heading.bad_unit.empty();
    for (const auto& cell : column.cells) {
      if (cell && !cell->unit.empty()) stated = cell->unit;
      all = all && (!cell || !cell->unit.empty() || cell->value == 0.0);
    }
    if (!stated.empty() && all) return stated;
    const LikelyUnit likely = likely_unit(column.quantity, unlabelled(column.quantity));
    unit_problem(k, likely);
    if (!stated.empty()) return stated;
    if (!likely.unit.empty()) return likely.unit;
    return column.quantity == Quantity::kAngle ? "deg" : "mm";
  }

  void unit_problem(std::size_t k, const LikelyUnit& likely) {
    const DhColumn& column = columns_[k];
    const std::string& name = column.heading.name;
    const bool angle = column.quantity == Quantity::kAngle;
    std::string help =
        likely.unit.empty()
            ? fmt::format("rename it to '{0}_{1}', or to '{0}_{2}' if its numbers are in {2}", name,
                          angle ? "deg" : "mm", angle ? "rad" : "m")
            : fmt::format("rename it to '{}_{}': {}", name, likely.unit, likely.reason);
    std::string message = fmt::format("column '{}' has no unit", table_.columns[k].header);
    const std::string& bad = column.heading.bad_unit;
    if (!bad.empty()) {
      message = fmt::format("column '{}': '{}' is not a unit", table_.columns[k].header, bad);
      if (const ForeignUnit* foreign = foreign_unit(bad))
        help = fmt::format("convert the numbers and rename it to '{}_{}': {}", name, foreign->use,
                           foreign->equals);
    }
    problems_.error("E-CSV-UNIT", std::move(message), column.place, std::move(help));
  }

  void fill(std::size_t k, const std::string& unit) {
    Column& column = table_.columns[k];
    column.unit = unit;
    column.quantity = columns_[k].quantity = unit_of(unit)->quantity;
    for (const auto& cell : columns_[k].cells) {
      const std::string& own = cell && !cell->unit.empty() ? cell->unit : unit;
      column.values.push_back(cell ? unit_of(own)->to_si(cell->value)
                                   : std::numeric_limits<double>::quiet_NaN());
    }
  }

  ProblemList& problems_;
  Table table_;
  std::vector<DhColumn> columns_;
  std::vector<CsvCell> cells_;
  char separator_ = ',';
  int number_ = 0;
  bool no_table_ = false;
};

}  // namespace

Table parse_dh_table(std::string_view text, const std::string& file, ProblemList& problems) {
  if (const std::string name = utf16_name(text); !name.empty()) {
    problems.error("E-CSV-UTF8", "the file is UTF-16, not UTF-8", Place{.file = file},
                   fmt::format("iconv -f {} -t UTF-8 {} > dh-utf8.csv", name, shell_word(file)));
    return {};
  }
  if (!text.empty() && !text.starts_with("PK\x03\x04")) check_bytes(text, file);
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return DhTableReader(file, problems).read(text);
}

}  // namespace plumb::offline::cli
