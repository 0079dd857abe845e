// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Residuals in the order of measuring. Immediate repeats of a pose are averaged to one visit: they
/// have the same model error because they share the pose, which must not look like an effect of
/// time.
struct Series {
  std::vector<int> first_row, last_row;  // first and last row of the measurements of each visit
  Rows3 error_M;  // mean residual of each visit, measurement frame [m]; missing axes are 0
  std::array<bool, 3> has_axis{true, true, true};
  int size() const { return static_cast<int>(first_row.size()); }
  int axes() const { return int{has_axis[0]} + int{has_axis[1]} + int{has_axis[2]}; }
};

/// Ordered by time if every row has a time, else by row. error_M: shape (all rows, 3) [m]; rows:
/// the rows to use.
Series series(const Measurements& measured, const Rows3& error_M, std::vector<int> rows);

}  // namespace plumb::offline
