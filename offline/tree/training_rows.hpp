// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace plumb::offline {

/// Training samples in the order and layout that the search needs. Each row is a sample: the leaf
/// terms that are used, then the outputs. The rows are in lexicographic order, so that the result
/// does not depend on the order in which they were given.
struct TrainingRows {
  std::vector<int> terms;  // indices of the leaf_terms in use, without the constant
  int inputs = 0;          // number of leading terms that are inputs and can be split
  int outputs = 0;
  int rows = 0;
  int stride = 0;              // terms.size() + outputs
  std::vector<double> values;  // shape (rows, stride)

  double value(int row, int column) const { return values[row * stride + column]; }
  int term_count() const { return static_cast<int>(terms.size()); }
};

}  // namespace plumb::offline
