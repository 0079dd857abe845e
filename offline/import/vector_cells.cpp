// SPDX-License-Identifier: Apache-2.0
#include "import/vector_cells.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "import/cells.hpp"
#include "import/heading.hpp"
#include "import/number_text.hpp"
#include "import/words.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

/// The number of parts that all vectors of a column have; 0 if it holds anything else.
std::size_t size_of_vectors(const RawRows& rows, std::size_t column) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < rows.cells.size(); ++i) {
    const auto parts = vector_parts(rows.cells[i][column]).size();
    if (parts == 0 || (size > 0 && parts != size)) return 0;
    size = parts;
  }
  return size;
}

std::vector<std::string> names_of(const std::string& header, std::size_t size) {
  const WrittenHeading heading = read_heading(header);
  const std::string unit = heading.unit.empty() && heading.foreign.empty()
                               ? ""
                               : fmt::format(" [{}{}]", heading.unit, heading.foreign);
  const bool axes = size == 3 && !named_column(heading.name + " x").name.empty();
  std::string one = heading.name;
  if (!axes && one.size() > 2 && one.ends_with('s')) one.pop_back();
  std::vector<std::string> out;
  for (std::size_t k = 0; k < size; ++k)
    out.push_back(
        fmt::format("{} {}{}", one, axes ? std::string(1, "xyz"[k]) : std::to_string(k + 1), unit));
  return out;
}

void expand(RawRows& rows, std::size_t column, std::size_t size) {
  auto& d = rows.dialect;
  const auto at = static_cast<std::ptrdiff_t>(column);
  const auto names = names_of(d.header[column], size);
  d.header.erase(d.header.begin() + at);
  d.header.insert(d.header.begin() + at, names.begin(), names.end());
  if (column < d.units.size()) d.units.insert(d.units.begin() + at, size - 1, d.units[column]);
  CellTable longer(rows.cells.texts());
  longer.expect(rows.cells.size(), rows.cells.size() * d.header.size());
  for (std::size_t i = 0; i < rows.cells.size(); ++i) {
    Cells row(rows.cells[i].begin(), rows.cells[i].end());
    const Cells parts = vector_parts(row[column]);
    row.erase(row.begin() + at);
    row.insert(row.begin() + at, parts.begin(), parts.end());
    longer.add(row);
  }
  rows.cells = std::move(longer);
}

}  // namespace

void expand_vectors(const SourceText& text, RawRows& rows) {
  std::vector<std::string> expanded;
  for (std::size_t k = 0; k < rows.dialect.header.size(); ++k) {
    const std::size_t size = size_of_vectors(rows, k);
    if (size == 0) continue;
    const std::string from = rows.dialect.header[k];
    expand(rows, k, size);
    expanded.push_back(fmt::format("'{}' became '{}' to '{}'", from, rows.dialect.header[k],
                                   rows.dialect.header[k + size - 1]));
    k += size - 1;
  }
  if (expanded.empty()) return;
  rows.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-IMPORT-VECTOR",
       .message = fmt::format("several numbers stand in one cell: {}", fmt::join(expanded, ", ")),
       .place = Place{.file = text.file, .line = std::max(1, rows.dialect.header_line)},
       .help = "--map says what each of them is"});
}

}  // namespace plumb::offline
