// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cell/csv_line.hpp"
#include "cell/table.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {

/// A line of a file, for messages about it.
struct CsvPlace {
  const std::string& file;
  int line = 0;
  std::string_view text = {};

  /// The place of `part`, a piece of `text`; columns count characters.
  Place of(std::string_view part, std::string label) const;
};

/// ',' or ';' outside quotes, whichever the header holds; '\t' if neither but tabs.
char find_separator(std::string_view header);

/// The columns named by a header's cells, without values. What is wrong goes to `problems`.
std::vector<Column> read_header(const std::vector<CsvCell>& cells, const CsvPlace& place,
                                ProblemList& problems);

}  // namespace plumb::offline
