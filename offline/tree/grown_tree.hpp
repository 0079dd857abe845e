// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// The least-squares model of the samples of one cell, for all outputs.
struct LocalModel {
  std::vector<double> w;                          // outputs x leaf terms [m]
  double rss = 0.0;                               // of all outputs [m^2]
  std::array<double, format::kTreeAxes> y_min{};  // range of the samples [m]
  std::array<double, format::kTreeAxes> y_max{};
  int samples = 0;
};

/// A cell of the input space, which was a leaf when it was made and may have been split later.
struct TreeCell {
  LocalModel model;
  int depth = 0;
  int input = -1;  // input of its split; -1 if it was never split
  double threshold = 0.0;
  int low = -1, high = -1;  // its two parts; -1 if it was never split
  int split_at = 0;         // number of leaves when it was split

  bool is_split() const { return low >= 0; }
  double split_value(std::span<const double> u) const { return u[input]; }
};

/// For each cell of a grown tree, whether its split is used. Splits below an unused one have no
/// effect.
using Splits = std::vector<char>;

/// A crisp linear model tree that was grown best-first with exhaustive splits [Karlic 1992, Potts
/// 2005]. It contains the trees of all smaller sizes. blended_fit.hpp makes a smooth tree of it.
class GrownTree {
 public:
  int leaves() const { return cells.empty() ? 0 : static_cast<int>(split_order.size()) + 1; }

  /// Residual sum of squares with k leaves [m^2], k = 1 .. leaves(). Cost O(k).
  double rss(int k) const;

  /// The splits of the tree with k leaves.
  Splits first_splits(int k) const;

  /// The tree with these splits in the form of the model file, for one output.
  format::Tree cut(const Splits& stand, int output = 0) const;
  format::Tree cut(int k, int output = 0) const;

  /// The cells that are leaves of the tree with these splits, in the order of its leaves.
  std::vector<int> leaf_cells(const Splits& stand) const;

  /// The value of a cell's model at u, clamped to the range of its samples as in the runtime. u:
  /// shape (p,).
  double predict(int cell, std::span<const double> u, int output) const;

  std::vector<TreeCell> cells;   // all cells, parents before children
  std::vector<int> split_order;  // the cell that was split when the tree had 1, 2, ... leaves
  int inputs = 0;
  int degree = 1;
  int outputs = 1;
};

}  // namespace plumb::offline
