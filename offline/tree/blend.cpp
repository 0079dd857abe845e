// SPDX-License-Identifier: Apache-2.0
#include "tree/blend.hpp"

#include <algorithm>

#include "tree/walls.hpp"

namespace plumb::offline {
namespace {

constexpr double kNarrowest = 1e-6;  // half width, normalised; narrower ramps vanish in rounding

class Ramps {
 public:
  Ramps(format::Tree& tree, double overlap) : tree_(tree), overlap_(overlap) {
    tree_.blend_half_width.assign(tree_.nodes.size(), 0.0);
  }

  void along_axes(int node, const Walls& walls) {
    if (node < 0) return;
    const format::TreeNode& n = tree_.nodes[node];
    set(node, n.threshold - walls.low[n.input], walls.high[n.input] - n.threshold);
    Walls side = walls;
    side.high[n.input] = n.threshold;
    along_axes(n.low, side);
    side = walls;
    side.low[n.input] = n.threshold;
    along_axes(n.high, side);
  }

 private:
  void set(int node, double below, double above) {
    tree_.blend_half_width[node] = std::max(overlap_ * std::min(below, above), kNarrowest);
  }

  format::Tree& tree_;
  double overlap_;
};

}  // namespace

void add_ramps(format::Tree& tree, double overlap) {
  if (!tree.nodes.empty()) Ramps(tree, overlap).along_axes(0, {});
}

}  // namespace plumb::offline
