// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/table.hpp"

namespace plumb::offline {

/// One way in which rows may have been written otherwise.
struct RowFault {
  enum class Kind { kSign, kTurnUnit, kPointUnit, kShift } kind = Kind::kSign;
  int joint = 0;        // of kSign
  int shift = 0;        // of kShift: the point belongs to the joints so many rows further down
  double factor = 1.0;  // of the units: what the numbers must be multiplied by
  std::string is = {}, says = {};  // of the units: the one they are in, and the one of the heading
};

/// Rows first ... last, and median errors [m]: of these rows as they are and repaired, and of the
/// other rows.
struct FaultyRun {
  RowFault fault;
  int first = 0, last = -1;
  double before = 0.0, after = 0.0, others = 0.0;
  int count() const { return last - first + 1; }
};

/// The units that the headings of the measured points and of the turning joints say.
std::string unit_of_points(const Table& table);
std::string unit_of_turns(const Cell& cell, const Table& table);

/// W-CHECK-ROWS: what is wrong with the run, in which lines, and how to mend it. `places`: the rows
/// of the table among which first and last count.
Problem row_fault_finding(const Cell& cell, const Table& table, const std::vector<int>& places,
                          const FaultyRun& run);

}  // namespace plumb::offline
