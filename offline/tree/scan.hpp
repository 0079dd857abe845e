// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "tree/grown_tree.hpp"
#include "tree/training_rows.hpp"

namespace plumb::offline {

/// Neighbouring values closer than this are one value: the runtime's rounding of u could put a
/// sample on either side of a threshold between them.
inline constexpr double kSameValue = 1e-9;

/// A split of a cell along one input.
struct SplitCandidate {
  int column = -1;         // of TrainingRows; -1 if there is none
  double threshold = 0.0;  // rows with a value <= threshold go low
  double rss = 0.0;        // both sides together [m^2]

  bool found() const { return column >= 0; }
};

/// The range of the thresholds that may be chosen.
struct Admissible {
  double from = -2.0, to = 2.0;
};

/// Best split along one input, by exhaustive search over the rows of a cell. sorted[c]: the cell's
/// rows in the order of column c; admissible: shape (inputs,). Cost O(inputs terms^2 rows).
SplitCandidate best_split(const TrainingRows& rows, const std::vector<std::span<const int>>& sorted,
                          std::span<const Admissible> admissible, int min_samples);

/// The least-squares model of some rows, with coefficients for all leaf terms. all_terms: number of
/// terms of a leaf, including the constant.
LocalModel fit_cell_model(const TrainingRows& rows, std::span<const int> which, int all_terms);

/// The first term that depends linearly on the constant and the terms before it, or -1.
int dependent_term(const TrainingRows& rows);

}  // namespace plumb::offline
