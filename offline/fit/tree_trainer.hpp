// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// Rows are samples. Inputs u in [-1, 1], shape (n, p).
using Samples = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;

struct GrowthLimits {
  int max_leaves = 256;
  int min_samples = 0;  // per leaf; 0 = 3 (p + 1)
};

/// A crisp linear model tree grown best-first by exhaustive splits [Karlic 1992, Potts 2005], with
/// every size on the way: cut(k) is the tree after k leaves.
class GrownTree {
 public:
  int leaves() const;
  /// Residual sum of squares with k leaves, k = 1 .. leaves().
  double rss(int k) const;
  /// The tree with k leaves, k = 0 (no correction) .. leaves(), in the model file's form.
  format::Tree cut(int k) const;

  struct Split;
  struct Cell;
  std::vector<Cell> cells;    // every node ever made, parents before children
  std::vector<Split> splits;  // in the order they were made
  int inputs = 0;
};

/// Grows on (u, y), y shape (n,) [m]. Leaves keep full rank and min_samples; ties by lowest input,
/// then lowest threshold, so the tree depends on the data only. Cost O(p^3 n log n) a level.
GrownTree grow(const Samples& u, const Eigen::VectorXd& y, const GrowthLimits& limits);

struct TreeChoice {
  std::array<format::Tree, format::kTreeAxes> trees;
  format::Domain domain;
  std::array<int, format::kTreeAxes> leaves{};
  double cv_before_m = 0.0;  // RMS of the residual norm, cross-validated, no correction
  double cv_after_m = 0.0;   // the same with the chosen trees
  double gain_se_m = 0.0;    // standard error of the fall over folds
  std::string reason;        // one sentence: why this size, or why none
};

struct TreeSettings {
  double min_gain = 0.02;  // of cv_before; below it: no correction
  int folds = 5;
  std::uint64_t seed = 1;
  GrowthLimits growth;
};

/// Chooses the size by cross-validation inside the samples given (fit poses only); "no correction"
/// is a candidate and wins unless the fall exceeds min_gain and one standard error.
/// q: (n, joints) [rad] or [m]; residual: (n, 3) [m], base frame; axis_used: measured axes;
/// group: replicates share a number and a fold.
TreeChoice choose_trees(const Samples& q, const Samples& residual,
                        const std::array<bool, 3>& axis_used, std::span<const int> group,
                        const TreeSettings& settings);

}  // namespace plumb::offline
