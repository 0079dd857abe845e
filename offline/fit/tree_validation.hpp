// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "fit/tree_growth.hpp"

namespace plumb::offline {

/// Held-out squared errors of trees of every size, fold by fold.
struct Validation {
  /// Per axis: shape (folds, largest size + 1) [m^2], sums over the fold's held-out rows; column k
  /// is the tree with k leaves, column 0 no correction. Unused axes have no columns.
  std::array<Eigen::MatrixXd, 3> squared_error;
  Eigen::VectorXd rows;  // held out in each fold

  bool has_axis(int axis) const { return squared_error[axis].cols() > 0; }
};

/// Grows a tree for each axis and fold without the fold's rows, normalised to the box of the
/// others, and evaluates it on them exactly as the runtime would: clamped to what a leaf saw and
/// faded outside the box.
Validation cross_validate(const Samples& q, const Samples& residual,
                          const std::array<bool, 3>& axis_used, const std::vector<int>& fold,
                          int folds, const GrowthLimits& limits);

/// Squared error of every size of one tree, shape (leaves + 1,). trust: shape (n,), see
/// tree_domain.hpp. Cost O(depth p + leaves) a row.
Eigen::VectorXd error_by_size(const GrownTree& tree, const Samples& u, const Eigen::VectorXd& trust,
                              const Eigen::VectorXd& y);

}  // namespace plumb::offline
