// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tree/blended_fit.hpp"
#include "tree/growth.hpp"

namespace plumb::offline {

/// The settings for growing a tree that will be blended: cells are halved, and the ramps extend
/// over whole cells. Such splits blend far better than those that are best for a crisp tree.
inline constexpr GrowthSettings kBlendedGrowth{.max_leaves = format::kMaxTreeLeaves,
                                               .min_side = 0.5};

struct BlendSettings {
  GrowthSettings growth = kBlendedGrowth;  // max_leaves limits the largest tree
  double overlap = 1.0;                    // of the ramps; reduced to respect kMaxActiveLeaves
  double path_ridge = 1e-9;                // for the trees that decide which leaves to split next
};

/// Blended trees of growing size on the same samples. Each is the one before with those leaves
/// split that have the largest error sum_i Phi_k(u_i) e_i^2. Every tree respects kMaxActiveLeaves.
/// Growth ends where even narrower ramps cannot achieve this, because too many cells meet in one
/// point.
/// Cost: one growth; then a global least squares a step, steps growing by a third.
class BlendedPath {
 public:
  /// u: (n, p); y: (n, outputs), which share the splits. Both must outlive it.
  BlendedPath(const Samples& u, const Samples& y, const BlendSettings& settings);

  /// The present number of leaves; 0 if there are too few samples for one leaf.
  int leaves() const { return leaves_; }

  /// Splits leaves until there are this many. Returns false if there are too few samples for so
  /// many; the tree then has its largest size.
  bool grow_to(int leaves);

  /// The trees of the present size, one for each output.
  std::vector<format::Tree> solve(double ridge) const;

 private:
  bool make_fit();
  std::vector<double> losses() const;

  const Samples& u_;
  const Samples& y_;
  BlendSettings settings_;
  GrownTree grown_;
  Splits stand_;            // the splits that are made so far
  std::vector<int> cells_;  // the cells that are leaves
  int leaves_ = 0;
  std::unique_ptr<BlendedFit> fit_;
};

/// The tree with ramps as wide as `overlap` and kMaxActiveLeaves allow. Nothing if even narrow
/// ramps make too many leaves active at some point.
std::optional<format::Tree> with_ramps(format::Tree tree, const Samples& u, double overlap);

/// Fills `region` with the box in which each leaf was trained: that of the samples where the leaf
/// is active, widened by a quarter of its width, and to the end of the trained range of an input if
/// that is near. There is no region if every leaf has samples in all of its domain.
void add_regions(format::Tree& tree, const Samples& u);

}  // namespace plumb::offline
