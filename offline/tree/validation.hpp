// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "tree/growth.hpp"

namespace plumb::offline {

/// A tree that competes; no leaves is no correction.
struct TreeCandidate {
  int degree = 1;
  int leaves = 0;
  double ridge = 0.0;  // of the global least squares; a crisp tree has none

  int coefficients(int inputs) const {
    return leaves * static_cast<int>(format::leaf_terms(inputs, degree));
  }
};

/// Held-out squared errors of every candidate, fold by fold. Candidate 0 is no correction.
struct Validation {
  std::vector<TreeCandidate> candidates;
  std::array<Eigen::MatrixXd, 3> squared_error;  // per axis: (folds, candidates) [m^2]; or none
  std::array<Eigen::MatrixXf, 3> error;          // per axis: (n, candidates) [m]; blended only
  Eigen::VectorXd rows;                          // held out in each fold

  bool has_axis(int axis) const { return squared_error[axis].cols() > 0; }
};

/// What is validated: (q, residual) as choose_trees takes them, and the fold of every row.
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

/// kShared: one tree for all axes, with numbers of its own for each. kOwn: a tree an axis.
enum class Sharing { kShared, kOwn };

/// The same with blended trees of a ladder of sizes and ridges and of every degree up to
/// growth.degree. A fold stops growing where it has clearly become worse.
Validation validate_blended(const FoldedSamples& samples, const GrowthSettings& growth,
                            Sharing sharing);

/// Columns of the axes that are used, and which axis each is.
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
