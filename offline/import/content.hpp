// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "import/raw_rows.hpp"

namespace plumb::offline {

/// The content of a column below its heading.
struct ColumnContent {
  bool empty = true;            // all cells are empty
  std::vector<double> numbers;  // of a sample of rows; none if a cell of the sample is no number
  double largest = 0.0;         // largest absolute value of `numbers`
  bool numeric() const { return !numbers.empty(); }
};

/// One for each column of the header. Looks at 500 rows, at all of them for `empty`.
std::vector<ColumnContent> column_contents(const RawRows& rows);

/// Units that numbers of this size may have, most usual first, and why.
struct UnitChoice {
  std::vector<std::string> units;
  std::string reason;  // "up to 1250: in mm 1.25 m"
  /// "mm", or "mm|um" where one is to be chosen.
  std::string text() const;
};

/// `name`: canonical, "q1", "sx"; `largest`: of the columns of its kind, as written.
UnitChoice unit_choice(const std::string& name, double largest);

}  // namespace plumb::offline
