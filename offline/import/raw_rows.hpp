// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "import/cell_table.hpp"
#include "import/source_text.hpp"
#include "import/stated_units.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// How a file is written.
struct Dialect {
  char separator = ',';
  char decimal = '.';
  int header_line = 0;  // 0: the file has none
  int unit_line = 0;    // a row of units under the header, 0 if none
  std::vector<std::string> header;
  std::vector<std::string> units;  // of the unit row, or empty
};

/// Rows of texts as cut from the lines, with their line numbers.
struct RawRows {
  explicit RawRows(const SourceText& text) : cells(text.texts) {}

  Dialect dialect;
  std::vector<int> lines;
  CellTable cells;
  std::vector<std::pair<std::string, std::string>> comments;  // "# key: value"
  StatedUnits stated;
  std::vector<Problem> remarks;
  std::vector<Problem> faults;  // rows with too few or too many cells, which `cells` lacks

  /// Keeps the rows that `keep(row)` tells, asked from the first to the last.
  template <class Keep>
  void keep_rows(Keep keep) {
    std::size_t kept = 0;
    cells.keep_rows([&](std::size_t i) {
      if (!keep(i)) return false;
      lines[kept++] = lines[i];
      return true;
    });
    lines.resize(kept);
  }
};

}  // namespace plumb::offline
