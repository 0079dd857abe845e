// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "fit/tree_growth.hpp"
#include "fit/tree_rows.hpp"

namespace plumb::offline {

/// Neighbouring values closer than this are one value: the runtime's rounding of u could put a
/// sample on either side of a threshold between them.
inline constexpr double kSameValue = 1e-9;

struct SplitCandidate {
  int column = -1;         // of TrainingRows; -1: no admissible split
  double threshold = 0.0;  // rows with value <= threshold go low
  double rss = 0.0;        // both sides together [m^2]
};

/// Best split by exhaustive search over the rows of a cell. sorted[c]: the cell's rows in the order
/// of column c. Cost O(p^3 rows).
SplitCandidate best_split(const TrainingRows& rows, const std::vector<std::span<const int>>& sorted,
                          int min_samples);

/// Least squares on some rows, in terms of all inputs of u.
LocalModel fit_cell_model(const TrainingRows& rows, std::span<const int> which);

/// First column that depends on the constant and the columns before it, or -1.
int dependent_input(const TrainingRows& rows);

}  // namespace plumb::offline
