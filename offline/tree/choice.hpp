// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "plumb/format/model.hpp"
#include "tree/blended_path.hpp"
#include "tree/growth.hpp"
#include "tree/validation.hpp"

namespace plumb::offline {

struct TreeChoice {
  std::array<format::Tree, format::kTreeAxes> trees;
  format::Domain domain;
  std::array<int, format::kTreeAxes> leaves{};
  double cv_before_m = 0.0;  // RMS of the residual norm, cross-validated, no correction
  double cv_after_m = 0.0;   // the same with the chosen trees
  double gain_se_m = 0.0;    // standard error of the reduction over folds
  std::string reason;        // one sentence: why this size, or why no tree
};

/// kEither: blended trees, unless the cross-validated error of crisp trees is lower by more than
/// 5 %, because crisp trees step at the borders of their leaves. That can happen with many crisp
/// leaves, on thousands of scattered poses of six joints.
enum class TreeForm { kBlended, kCrisp, kEither };

/// Blended trees have leaves up to quadratic, crisp trees have affine leaves.
struct TreeSettings {
  double min_gain = 0.02;  // share of cv_before_m; for less there is no correction
  int folds = 5;           // 2 .. 10
  std::uint64_t seed = 1;
  TreeForm form = TreeForm::kEither;
  Sharing sharing = Sharing::kShared;  // of blended trees
  int max_leaves = 256;
  int max_degree = 2;   // of blended trees
  int min_samples = 0;  // per leaf; 0 = 3 times its coefficients
};

/// Chooses the size of the trees by cross-validation inside the given samples, which are fit poses
/// only. "No correction" is a candidate. It is chosen unless the error is reduced by more than
/// min_gain (with few poses (joints + 3) / poses) and more than one standard error, for each axis
/// and for all together. Among the candidates within one standard error of the best, the one with
/// the fewest coefficients is chosen. There is no tree with fewer than 10 poses for each
/// coefficient of a leaf.
/// q: (n, joints) [rad] or [m]; residual: (n, 3) [m], base frame; axis_used: measured axes;
/// group: repeats of a pose have the same number and are in the same fold. The order of the rows
/// does not matter.
TreeChoice choose_trees(const Samples& q, const Samples& residual,
                        const std::array<bool, 3>& axis_used, std::span<const int> group,
                        const TreeSettings& settings);

}  // namespace plumb::offline
