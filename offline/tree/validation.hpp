// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "tree/growth.hpp"

namespace plumb::offline {

/// A candidate for the choice of a tree; without leaves it means no correction.
struct TreeCandidate {
  int degree = 1;
  int leaves = 0;
  double ridge = 0.0;  // of the global least squares; unused for crisp trees

  int coefficients(int inputs) const {
    return leaves * static_cast<int>(format::leaf_terms(inputs, degree));
  }
};

/// Held-out squared errors of every candidate, fold by fold. Candidate 0 is no correction.
struct Validation {
  std::vector<TreeCandidate> candidates;
  std::array<Eigen::MatrixXd, 3> squared_error;  // per axis: (folds, candidates) [m^2], or empty
  std::array<Eigen::MatrixXf, 3> error;          // per axis: (n, candidates) [m]; blended only
  Eigen::VectorXd rows;                          // number of rows held out in each fold

  bool has_axis(int axis) const { return squared_error[axis].cols() > 0; }
};

/// The samples for the validation: (q, residual) as choose_trees takes them, and the fold of every
/// row.
struct FoldedSamples {
  const Samples& q;
  const Samples& residual;
  const std::array<bool, 3>& axis_used;
  const std::vector<int>& fold;
  int folds;
};

/// Grows a tree for each axis and fold without the fold's rows, normalised to the box of the
/// others, and evaluates it on them exactly as the runtime would: clamped to what a leaf saw and
/// faded outside the box. Crisp trees of every size.
Validation validate_crisp(const FoldedSamples& samples, const GrowthSettings& growth);

/// kShared: all axes have the same splits, each with its own coefficients. kOwn: each axis has a
/// tree of its own.
enum class Sharing { kShared, kOwn };

/// The same with blended trees of several sizes and ridges and of every degree up to growth.degree.
/// Trees of a fold grow no further once their error has clearly become larger.
Validation validate_blended(const FoldedSamples& samples, const GrowthSettings& growth,
                            Sharing sharing);

/// The columns of the axes that are used, and the axis of each column.
struct UsedAxes {
  Samples y;
  std::vector<int> axis;
};
UsedAxes used_axes(const Samples& residual, const std::array<bool, 3>& axis_used);

/// Squared error of every size of one crisp tree, shape (leaves + 1,). trust: shape (n,), see
/// domain.hpp. Cost O(depth p + leaves) a row.
Eigen::VectorXd error_by_size(const GrownTree& tree, const Samples& u, const Eigen::VectorXd& trust,
                              const Eigen::VectorXd& y);

}  // namespace plumb::offline
