// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tree/blended_fit.hpp"
#include "tree/growth.hpp"

namespace plumb::offline {

/// How to grow a tree that will be blended: cells are halved and ramps cover them whole, which
/// blends far better than the splits that suit a crisp tree best.
inline constexpr GrowthSettings kBlendedGrowth{.max_leaves = format::kMaxTreeLeaves,
                                               .min_side = 0.5};

struct BlendSettings {
  GrowthSettings growth = kBlendedGrowth;  // max_leaves: of the largest tree
  double overlap = 1.0;      // of the ramps; less where more than kMaxActiveLeaves would have a say
  double path_ridge = 1e-9;  // of the trees that only say where to split next
};

/// Blended trees of growing size on the same samples: each is the one before with the leaves split
/// in which it errs most, by sum_i Phi_k(u_i) e_i^2. Every tree respects kMaxActiveLeaves: where
/// narrower ramps do not help, because too many cells meet in one point, it grows no further.
/// Cost: one growth; then a global least squares a step, steps growing by a third.
class BlendedPath {
 public:
  /// u: (n, p); y: (n, outputs), which share the splits. Both must outlive it.
  BlendedPath(const Samples& u, const Samples& y, const BlendSettings& settings);

  /// 0 if the samples carry no leaf.
  int leaves() const { return leaves_; }

  /// Splits on until there are so many leaves. False if the samples carry fewer: then it is at the
  /// largest size.
  bool grow_to(int leaves);

  /// The trees of this size, one an output.
  std::vector<format::Tree> solve(double ridge) const;

 private:
  bool make_fit();
  std::vector<double> losses() const;

  const Samples& u_;
  const Samples& y_;
  BlendSettings settings_;
  GrownTree grown_;
  Splits stand_;
  std::vector<int> cells_;  // of the leaves
  int leaves_ = 0;
  std::unique_ptr<BlendedFit> fit_;
};

/// The crisp structure with ramps as wide as `overlap` and kMaxActiveLeaves allow; none if even
/// narrow ones give too many leaves a say somewhere.
std::optional<format::Tree> with_ramps(format::Tree tree, const Samples& u, double overlap);

/// What each leaf was trained in: the box of the samples where it has a say, widened by a quarter
/// of its width and at least to where the input's trained range ends nearby. None if every leaf saw
/// all of its ground. Fills `region`.
void add_regions(format::Tree& tree, const Samples& u);

}  // namespace plumb::offline
