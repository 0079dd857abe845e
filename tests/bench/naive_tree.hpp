// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "plumb/runtime/detail/tree.hpp"

/// The tree as one writes it down first: a node a heap object, as many compares as it takes,
/// blending by recursion. The reference for speed and for what comes out.
namespace plumb::offline::bench {

class NaiveTree {
 public:
  NaiveTree(const format::Tree& tree, int inputs) : root_(make(tree, inputs, first(tree))) {}

  /// Error along the axis [m].
  double crisp(std::span<const double> u) const {
    const Node* at = root_.get();
    while (at->low) at = (u[at->input] <= at->threshold ? at->low : at->high).get();
    return std::clamp(at->value(u), at->least, at->most);
  }

  double blended(std::span<const double> u) const {
    const Sum sum = add(*root_, u);
    const double margin = kSoftShare * (sum.most - sum.least);
    if (sum.y > sum.most) return sum.most + softly(sum.y - sum.most, margin);
    if (sum.y < sum.least) return sum.least - softly(sum.least - sum.y, margin);
    return sum.y;
  }

 private:
  struct Node {
    std::unique_ptr<Node> low, high;
    std::size_t input = 0;
    double threshold = 0.0, half_width = 0.0;
    std::vector<double> w;
    double least = 0.0, most = 0.0;

    double value(std::span<const double> u) const {
      double out = w[0];
      for (std::size_t i = 0; i < u.size(); ++i) out += w[i + 1] * u[i];
      return out;
    }
  };

  struct Sum {
    double y, least, most;
  };

  static double softly(double t, double margin) { return margin * t / (margin + t); }

  static int first(const format::Tree& tree) { return tree.nodes.empty() ? ~0 : 0; }

  static std::unique_ptr<Node> make(const format::Tree& tree, int inputs, int at) {
    auto out = std::make_unique<Node>();
    if (at < 0) {
      const int leaf = ~at;
      const auto w = tree.coefficients.begin() + leaf * (inputs + 1);
      out->w.assign(w, w + inputs + 1);
      out->least = tree.bounds[2 * leaf];
      out->most = tree.bounds[2 * leaf + 1];
      return out;
    }
    const format::TreeNode& node = tree.nodes[at];
    out->input = node.input;
    out->threshold = node.threshold;
    if (!tree.blend_half_width.empty()) out->half_width = tree.blend_half_width[at];
    out->low = make(tree, inputs, node.low);
    out->high = make(tree, inputs, node.high);
    return out;
  }

  static Sum add(const Node& at, std::span<const double> u) {
    if (!at.low) return {at.value(u), at.least, at.most};
    const double x = (u[at.input] - at.threshold + at.half_width) / (2.0 * at.half_width);
    const double s = std::clamp(x, 0.0, 1.0);
    if (s == 0.0) return add(*at.low, u);
    if (s == 1.0) return add(*at.high, u);
    const double high = s * s * (3.0 - 2.0 * s), low = 1.0 - high;
    const Sum a = add(*at.low, u), b = add(*at.high, u);
    return {low * a.y + high * b.y, low * a.least + high * b.least, low * a.most + high * b.most};
  }

  std::unique_ptr<Node> root_;
};

}  // namespace plumb::offline::bench
