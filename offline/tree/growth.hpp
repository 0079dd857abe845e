// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"
#include "tree/grown_tree.hpp"
#include "tree/samples.hpp"

namespace plumb::offline {

struct GrowthSettings {
  int max_leaves = 256;
  int min_samples = 0;                    // per leaf; 0 = 3 times its coefficients
  int max_depth = format::kMaxTreeDepth;  // comparisons on the way to a leaf
  int degree = 1;                         // of the leaves: affine or quadratic
  double min_side = 0.0;  // share of a cell's width that either side of a split keeps, 0 .. 0.5;
};                        // 0.5 halves cells as LOLIMOT does. Wide cells blend better.

/// Grows on (u, y), u: (n, p) in [-1, 1], p <= kMaxJoints, y: (n, 1 .. 3) [m]: several outputs
/// share the splits that lower their errors together. Every leaf keeps min_samples and a design of
/// full rank (condition at most about 1e7); terms that depend on earlier ones in all samples get no
/// coefficient and no split. Thresholds lie midway between neighbouring values. Of equal splits the
/// one with the lowest input, then with the lowest threshold, is chosen. The result is the same to
/// the last bit for any order of the rows. Fewer than min_samples rows: no leaves.
/// Cost O(p terms^2 n) a level after one sort.
GrownTree grow(const Samples& u, const Samples& y, const GrowthSettings& settings);

}  // namespace plumb::offline
