// SPDX-License-Identifier: Apache-2.0
#include "import/cell_units.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "import/heading.hpp"
#include "import/number_text.hpp"
#include "import/words.hpp"
#include "program/problem.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kCellsToJudge = 1000;

[[noreturn]] void refuse(const SourceText& text, const RawRows& rows, std::size_t row,
                         std::string message, std::string help) {
  const int line = rows.lines[row];
  throw Failure(Exit::kInput, {.code = "E-IMPORT-CELLS",
                               .message = std::move(message),
                               .place = Place{.file = text.file,
                                              .line = line,
                                              .column = 1,
                                              .source = std::string(text.lines[line - 1])},
                               .help = std::move(help)});
}

/// A number without its unit.
struct Stripped {
  std::string_view number;
  std::string unit;
  std::optional<double> degrees;  // of an angle in minutes and seconds
};

Stripped stripped(std::string_view cell) {
  if (const auto degrees = sexagesimal(cell)) return {cell, "deg", degrees};
  if (const auto measured = measured_cell(cell)) return {measured->number, measured->unit, {}};
  return {cell, "", {}};
}

/// The unit of the cells of a column; empty if fewer than half of those that are not empty have
/// one.
std::string unit_of_cells(const SourceText& text, const RawRows& rows, std::size_t column) {
  std::string unit;
  std::size_t with_unit = 0, filled = 0;
  std::optional<std::size_t> other;
  for (std::size_t i = 0; i < rows.cells.size(); ++i) {
    const auto cell = rows.cells[i][column];
    if (cell.empty()) continue;
    if (++filled > kCellsToJudge && with_unit == 0) return {};
    const std::string found = stripped(cell).unit;
    if (found.empty()) {
      if (filled == 1 && i > 0) continue;
      if (!number_in(cell, '.') && !number_in(cell, ',') && with_unit == 0) return {};
      continue;
    }
    ++with_unit;
    if (unit.empty()) unit = found;
    if (unit != found && !other) other = i;
  }
  if (2 * with_unit < filled) return {};
  if (other)
    refuse(
        text, rows, *other,
        fmt::format("the cells of column '{}' have different units: {} and {}",
                    rows.dialect.header[column], unit, stripped(rows.cells[*other][column]).unit),
        "write all cells of a column in one unit");
  return unit;
}

void look_at_heading(const SourceText& text, const RawRows& rows, std::size_t column,
                     const std::string& unit) {
  const std::string& header = rows.dialect.header[column];
  const WrittenHeading heading = read_heading(header);
  const std::string said = heading.unit.empty() ? heading.foreign : heading.unit;
  if (!said.empty() && said != unit)
    refuse(text, rows, 0,
           fmt::format("column '{}' says {}, and its cells say {}", header, said, unit),
           "write the unit once, in the heading");
}

void strip(RawRows& rows, std::size_t column) {
  for (std::size_t i = 0; i < rows.cells.size(); ++i) {
    const Stripped found = stripped(rows.cells[i][column]);
    std::string number = found.degrees ? fmt::format("{:.12g}", *found.degrees) : "";
    std::replace(number.begin(), number.end(), '.', rows.dialect.decimal);
    rows.cells.set(i, column, found.degrees ? std::string_view(number) : found.number);
  }
}

bool is_label(const std::string& header) {
  const std::string name = named_column(header).name;
  return name == "pose" || name == "note" || name == "set" || name == "setup" || name == "time" ||
         name == "date";
}

}  // namespace

void take_units_from_cells(const SourceText& text, RawRows& rows) {
  auto& d = rows.dialect;
  std::vector<std::string> columns;
  for (std::size_t k = 0; k < d.header.size(); ++k) {
    if (is_label(d.header[k])) continue;
    const std::string unit = unit_of_cells(text, rows, k);
    if (unit.empty()) continue;
    look_at_heading(text, rows, k, unit);
    d.units.resize(std::max(d.units.size(), d.header.size()));
    d.units[k] = unit;
    strip(rows, k);
    columns.push_back(fmt::format("{} [{}]", d.header[k], unit));
  }
  if (columns.empty()) return;
  rows.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-IMPORT-CELLS",
       .message = fmt::format("the units stand in the cells: {}", fmt::join(columns, ", ")),
       .place = Place{.file = text.file, .line = rows.lines.empty() ? 1 : rows.lines.front()},
       .help = "--map says otherwise"});
}

}  // namespace plumb::offline
