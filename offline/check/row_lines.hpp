// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// The table and the row in it that a row of the joined measurements comes from.
struct RowPlace {
  int table = 0;
  int row = 0;  // of that table
};
RowPlace row_place(const MeasurementFiles& measured, int row);

/// The line in its file of a row of the joined measurements. Precondition: it was read from a file.
int line_of_row(const MeasurementFiles& measured, int row);

/// "line 7" or "lines 7, 9, 12, 20, 31, ...": at most five of them, in the order of `rows`.
std::string listed_lines(const MeasurementFiles& measured, const std::vector<int>& rows);

/// The table cell of a row in a column, with a label; the file alone if it lacks the column;
/// nothing if the rows were not read from a file.
std::optional<Place> cell_of_row(const MeasurementFiles& measured, int row,
                                 const std::string& column, std::string label);

}  // namespace plumb::offline
