// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tree/samples.hpp"

namespace plumb::offline {

/// Training samples in the order and layout the search wants: one row a sample, the leaf terms
/// that are used and then the outputs; rows in lexicographic order, so that nothing depends on the
/// order given.
struct TrainingRows {
  std::vector<int> terms;  // of leaf_terms, in their order; the constant is not among them
  int inputs = 0;          // the first so many terms are inputs, and can be split
  int outputs = 0;
  int rows = 0;
  int stride = 0;              // terms.size() + outputs
  std::vector<double> values;  // shape (rows, stride)

  double value(int row, int column) const { return values[row * stride + column]; }
  int term_count() const { return static_cast<int>(terms.size()); }
};

/// Row numbers of a matrix in the lexicographic order of its columns.
std::vector<int> lexicographic(const Samples& table);

/// Without the terms that depend on earlier ones in all samples; perhaps none remain.
/// u: (n, p), y: (n, outputs), degree: of the leaves.
TrainingRows training_rows(const Samples& u, const Samples& y, int degree);

}  // namespace plumb::offline
