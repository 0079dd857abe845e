// SPDX-License-Identifier: Apache-2.0
#include "cell/table_place.hpp"

#include "cell/csv_header.hpp"

namespace plumb::offline {
namespace {

Place place_in_line(const Table& table, int number, std::string_view line, const Column& column,
                    std::string label) {
  std::vector<CsvCell> cells;
  cut_line(line, ',', cells);
  const auto index = static_cast<std::size_t>(&column - table.columns.data());
  if (number <= 0 || index >= cells.size()) return {.file = table.file};
  return CsvPlace{table.file, number, line}.of(cells[index].text, std::move(label));
}

}  // namespace

Place place_in_header(const Table& table, const Column& column, std::string label) {
  return place_in_line(table, table.header_line, table.raw_header, column, std::move(label));
}

Place place_of_missing(const Table& table, std::string label) {
  const std::string_view header = table.raw_header;
  if (table.header_line <= 0) return {.file = table.file};
  return CsvPlace{table.file, table.header_line, header}.of(header.substr(header.size()),
                                                            std::move(label));
}

Place place_in_row(const Table& table, int row, const Column& column, std::string label) {
  return place_in_line(table, table.lines[row], table.raw_rows.view(row), column, std::move(label));
}

}  // namespace plumb::offline
