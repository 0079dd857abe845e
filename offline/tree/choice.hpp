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
  double gain_se_m = 0.0;    // standard error of the fall over folds
  std::string reason;        // one sentence: why this size, or why none
};

/// kEither: blended, unless crisp trees lower the cross-validated error by a twentieth more; with
/// thousands of scattered poses of six joints many crisp leaves may.
enum class TreeForm { kBlended, kCrisp, kEither };

/// Leaves up to quadratic for blended trees, affine ones for crisp trees.
struct TreeSettings {
  double min_gain = 0.02;  // of cv_before; below it: no correction
  int folds = 5;           // 2 .. 10
  std::uint64_t seed = 1;
  TreeForm form = TreeForm::kEither;
  Sharing sharing = Sharing::kShared;  // of blended trees
  int max_leaves = 256;
  int max_degree = 2;   // of blended trees
  int min_samples = 0;  // per leaf; 0 = 3 times its coefficients
};

/// Chooses the size by cross-validation inside the samples given (fit poses only); "no correction"
/// is a candidate and wins unless the fall exceeds min_gain (with few poses: (joints + 3) / poses)
/// and one standard error, for each axis and for all together. Of the candidates within one
/// standard error of the best, the one with the fewest coefficients. Fewer than 10 poses a
/// coefficient of a leaf: none.
/// q: (n, joints) [rad] or [m]; residual: (n, 3) [m], base frame; axis_used: measured axes;
/// group: replicates share a number and a fold. The order of the rows does not matter.
TreeChoice choose_trees(const Samples& q, const Samples& residual,
                        const std::array<bool, 3>& axis_used, std::span<const int> group,
                        const TreeSettings& settings);

}  // namespace plumb::offline
