// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "import/source_text.hpp"
#include "import/stated_units.hpp"

namespace plumb::offline {

/// What the user states about a file; the rest is detected.
struct DialectWishes {
  std::optional<char> separator;  // ' ' stands for any run of blanks
  std::optional<char> decimal;    // '.' or ','
  std::vector<std::string> header;
};

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
  Dialect dialect;
  std::vector<int> lines;
  std::vector<std::vector<std::string_view>> cells;
  std::vector<std::pair<std::string, std::string>> comments;  // "# key: value"
  StatedUnits stated;
  std::deque<std::string> made;  // texts of cells that are written in no line
  std::vector<Problem> remarks;
  std::vector<Problem> faults;  // rows with too few or too many cells, which `cells` lacks
};

/// Finds separator, decimal sign, header and units, and cuts every row. Throws Failure (kInput):
/// E-IMPORT-HEADER (none, or none found), E-IMPORT-DECIMAL (a
/// comma that may mean either), E-IMPORT-ROWS (a header and nothing else).
RawRows cut(const SourceText& text, const DialectWishes& wishes);

}  // namespace plumb::offline
