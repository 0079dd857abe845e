// SPDX-License-Identifier: Apache-2.0
#include "check/row_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/table_place.hpp"

namespace plumb::offline {
namespace {

/// Lines that a message names.
constexpr std::size_t kLinesListed = 5;

}  // namespace

RowPlace row_place(const MeasurementFiles& measured, int row) {
  RowPlace out{0, row};
  while (out.table + 1 < static_cast<int>(measured.tables.size()) &&
         out.row >= measured.tables[out.table].rows())
    out.row -= measured.tables[out.table++].rows();
  return out;
}

int line_of_row(const MeasurementFiles& measured, int row) {
  const RowPlace at = row_place(measured, row);
  return measured.tables[at.table].lines[at.row];
}

std::string listed_lines(const MeasurementFiles& measured, const std::vector<int>& rows) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < std::min(rows.size(), kLinesListed); ++k)
    lines.push_back(fmt::format("{}", line_of_row(measured, rows[k])));
  return fmt::format("{} {}{}", rows.size() == 1 ? "line" : "lines", fmt::join(lines, ", "),
                     rows.size() > kLinesListed ? ", ..." : "");
}

std::optional<Place> cell_of_row(const MeasurementFiles& measured, int row,
                                 const std::string& column, std::string label) {
  if (measured.tables.empty()) return std::nullopt;
  const RowPlace at = row_place(measured, row);
  const Table& table = measured.tables[at.table];
  const Column* found = table.find(column);
  if (found == nullptr) return Place{.file = table.file};
  return place_in_row(table, at.row, *found, std::move(label));
}

}  // namespace plumb::offline
