// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Where a row of the joined measurements stands.
struct RowPlace {
  int table = 0;
  int row = 0;  // of that table
};
RowPlace row_place(const MeasurementFiles& measured, int row);

/// The line of its file that a row of the joined measurements stands in.
int line_of_row(const MeasurementFiles& measured, int row);

/// "line 7" or "lines 7, 9, 12, 20, 31, ...": at most five of them, in the order of `rows`.
std::string listed_lines(const MeasurementFiles& measured, const std::vector<int>& rows);

/// The cell of a row in a column, with a label; the file alone if it lacks the column.
std::optional<Place> cell_of_row(const MeasurementFiles& measured, int row,
                                 const std::string& column, std::string label);

}  // namespace plumb::offline
