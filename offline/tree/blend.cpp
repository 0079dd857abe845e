// SPDX-License-Identifier: Apache-2.0
#include "tree/blend.hpp"

#include <algorithm>

#include "tree/walls.hpp"

namespace plumb::offline {
namespace {

constexpr double kNarrowest = 1e-6;  // half width, normalised; narrower ramps vanish in rounding

class Ramps {
 public:
  Ramps(format::Tree& tree, const Samples& u, double overlap)
      : tree_(tree), u_(u), overlap_(overlap) {
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

  void along_directions(int node, const std::vector<int>& rows) {
    if (node < 0) return;
    std::vector<int> low, high;
    double least = 1.0, most = -1.0;
    for (int row : rows) {
      const double x = projected(node, row);
      least = std::min(least, x);
      most = std::max(most, x);
      (x <= tree_.nodes[node].threshold ? low : high).push_back(row);
    }
    set(node, tree_.nodes[node].threshold - least, most - tree_.nodes[node].threshold);
    along_directions(tree_.nodes[node].low, low);
    along_directions(tree_.nodes[node].high, high);
  }

 private:
  double projected(int node, int row) const {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < u_.cols(); ++k)
      sum += tree_.directions[node * u_.cols() + k] * u_(row, k);
    return sum;
  }

  void set(int node, double below, double above) {
    tree_.blend_half_width[node] = std::max(overlap_ * std::min(below, above), kNarrowest);
  }

  format::Tree& tree_;
  const Samples& u_;
  double overlap_;
};

}  // namespace

void add_ramps(format::Tree& tree, const Samples& u, double overlap) {
  if (tree.nodes.empty()) return;
  Ramps ramps(tree, u, overlap);
  if (tree.directions.empty()) return ramps.along_axes(0, {});
  std::vector<int> all(u.rows());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  ramps.along_directions(0, all);
}

}  // namespace plumb::offline
