// SPDX-License-Identifier: Apache-2.0
#include "tree/active_bound.hpp"

#include <algorithm>
#include <array>
#include <queue>
#include <vector>

namespace plumb::offline {
namespace {

constexpr int kBoxes = 20000;  // largest number of boxes that are examined

struct Interval {
  double low = -1.0, high = 1.0;
  double middle() const { return 0.5 * (low + high); }
};

struct Box {
  std::array<Interval, format::kMaxJoints> side;
  int met = 0;  // upper bound of the active leaves at any of its points
  bool operator<(const Box& other) const { return met < other.met; }
};

/// The place to cut a box: the edge of a ramp that runs through it.
struct Cut {
  int input = -1;
  double at = 0.0;
  double centrality = -1.0;  // larger for cuts nearer to the middle
};

class Search {
 public:
  Search(const format::Tree& tree, int inputs) : tree_(tree), inputs_(inputs) {}

  int run() {
    std::priority_queue<Box> open;
    Cut cut;
    open.push(Box{.side = {}, .met = count(0, Box{}, cut)});
    for (int i = 0; i < kBoxes; ++i) {
      const Box box = open.top();
      cut = {};
      count(0, box, cut);
      if (cut.input < 0) return box.met;  // no edge runs through it: exact, and the maximum
      open.pop();
      for (const bool high : {false, true}) {
        Box part = box;
        (high ? part.side[cut.input].low : part.side[cut.input].high) = cut.at;
        Cut unused;
        part.met = count(0, part, unused);
        open.push(part);
      }
    }
    return open.top().met;
  }

 private:
  Interval range(int node, const Box& box) const {
    if (tree_.directions.empty()) return box.side[tree_.nodes[node].input];
    Interval out{0.0, 0.0};
    for (int k = 0; k < inputs_; ++k) {
      const double d = tree_.directions[static_cast<std::size_t>(node) * inputs_ + k];
      out.low += d * (d < 0.0 ? box.side[k].high : box.side[k].low);
      out.high += d * (d < 0.0 ? box.side[k].low : box.side[k].high);
    }
    return out;
  }

  /// Considers an edge inside the box as a cut. Its relative position in the range of the split
  /// value is between 0 and 1.
  void consider(int node, const Box& box, const Interval& x, double edge, Cut& cut) const {
    if (!(edge > x.low && edge < x.high)) return;
    const double place = (edge - x.low) / (x.high - x.low);
    const double centrality = std::min(place, 1.0 - place);
    if (centrality <= cut.centrality) return;
    cut.centrality = centrality;
    cut.input = tree_.nodes[node].input;
    cut.at = edge;
    if (tree_.directions.empty()) return;
    double widest = 0.0;  // for oblique splits: halve the side with the largest share
    for (int k = 0; k < inputs_; ++k) {
      const double d = tree_.directions[static_cast<std::size_t>(node) * inputs_ + k];
      const double width = std::abs(d) * (box.side[k].high - box.side[k].low);
      if (width <= widest) continue;
      widest = width;
      cut.input = k;
      cut.at = box.side[k].middle();
    }
  }

  int count(int node, const Box& box, Cut& cut) const {
    if (node < 0) return 1;
    const format::TreeNode& n = tree_.nodes[node];
    const Interval x = range(node, box);
    const double low = n.threshold - tree_.blend_half_width[node];
    const double high = n.threshold + tree_.blend_half_width[node];
    if (x.high <= low) return count(n.low, box, cut);
    if (x.low >= high) return count(n.high, box, cut);
    consider(node, box, x, low, cut);
    consider(node, box, x, high, cut);
    return count(n.low, box, cut) + count(n.high, box, cut);
  }

  const format::Tree& tree_;
  int inputs_;
};

}  // namespace

int most_active_leaves(const format::Tree& tree, int inputs) {
  if (tree.blend_half_width.empty()) return tree.leaves() > 0 ? 1 : 0;
  return Search(tree, inputs).run();
}

}  // namespace plumb::offline
