// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// Rows are samples. Inputs u in [-1, 1], shape (n, p).
using Samples = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;

struct GrowthLimits {
  int max_leaves = 256;
  int min_samples = 0;  // per leaf; 0 = 3 (p + 1)
};

/// Least squares on the samples of one cell.
struct LocalModel {
  std::array<double, format::kMaxJoints + 1> w{};  // constant first [m]; the rest per unit of u
  double rss = 0.0;                                // [m^2]
  double y_min = 0.0;                              // what was seen [m]
  double y_max = 0.0;
  int samples = 0;

  /// Clamped to what was seen, as the runtime does. u: shape (p,).
  double predict(std::span<const double> u) const;
};

/// A box of the input space that was a leaf once, and perhaps was split.
struct TreeCell {
  LocalModel model;
  int depth = 0;
  int input = -1;  // of its split; -1: never split
  double threshold = 0.0;
  int low = -1, high = -1;  // cells
  int split_at = 0;         // leaves of the tree when it was split; meaningful if input >= 0
};

/// A crisp linear model tree grown best-first by exhaustive splits [Karlic 1992, Potts 2005], with
/// every size on the way.
class GrownTree {
 public:
  int leaves() const { return cells.empty() ? 0 : static_cast<int>(split_order.size()) + 1; }

  /// Residual sum of squares with k leaves [m^2], k = 1 .. leaves(). Cost O(k).
  double rss(int k) const;

  /// The tree with k leaves, k = 0 (no correction) .. leaves(), in the model file's form.
  format::Tree cut(int k) const;

  /// Fewest leaves at which one more split lowers the rest of the RSS by less than `share` of it:
  /// the stop of the published study with share = 0.02.
  int leaves_at_gain(double share) const;

  std::vector<TreeCell> cells;   // every cell ever made, parents before children
  std::vector<int> split_order;  // the cell that was split when the tree had 1, 2, ... leaves
  int inputs = 0;
};

/// Grows on (u, y), u: (n, p) in [-1, 1], p <= kMaxJoints, y: shape (n,) [m]. Every leaf keeps
/// min_samples and a design of full rank (condition at most about 1e7); inputs that depend on
/// earlier ones in all samples get no coefficient and no split. Thresholds lie midway between
/// neighbouring values. Ties go to the lowest input, then the lowest threshold, and the result is
/// the same to the last bit for any order of the rows. Fewer than min_samples rows: no leaves.
/// Cost O(p^3 n) a level after one sort.
GrownTree grow(const Samples& u, const Eigen::VectorXd& y, const GrowthLimits& limits);

}  // namespace plumb::offline
