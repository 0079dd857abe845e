// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fit/tree_growth.hpp"

namespace plumb::offline {

/// Training samples in the order and layout the search wants: one row a sample, its inputs and
/// then y; rows in lexicographic order, so that nothing depends on the order given.
struct TrainingRows {
  std::vector<int> inputs;  // columns of u that are used
  int rows = 0;
  int stride = 0;              // inputs.size() + 1
  std::vector<double> values;  // shape (rows, stride)

  double value(int row, int column) const { return values[row * stride + column]; }
};

/// Row numbers of a matrix in the lexicographic order of its columns.
std::vector<int> lexicographic(const Samples& table);

/// Without the inputs that depend on earlier ones in all samples; perhaps none remain.
/// u: (n, p), y: (n,).
TrainingRows training_rows(const Samples& u, const Eigen::VectorXd& y);

}  // namespace plumb::offline
