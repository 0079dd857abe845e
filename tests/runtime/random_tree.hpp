// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "plumb/format/model.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::test {

/// What a random tree is like.
struct TreeKind {
  int inputs = 2;
  int leaves = 10;
  int degree = 1;
  bool oblique = false;
  bool region = false;
  double narrowest = 0.0, widest = 0.0;  // half widths, log-uniform; 0: crisp
  double slope = 1e-4;                   // of the coefficients [m]; bounds are about 1e-4
};

/// Coefficients, bounds, regions and sigmas for a tree that has its nodes.
inline void add_leaves(tests::Random& random, const TreeKind& kind, format::Tree& tree) {
  const int products = kind.degree == 2 ? kind.inputs * (kind.inputs + 1) / 2 : 0;
  for (int i = 0; i < kind.leaves * (1 + kind.inputs + products); ++i)
    tree.coefficients.push_back(random.uniform(-kind.slope, kind.slope));
  for (int i = 0; i < kind.leaves; ++i) {
    tree.bounds.push_back(random.uniform(-1e-4, 2e-5));
    tree.bounds.push_back(tree.bounds.back() + random.uniform(1e-5, 1e-4));
    tree.sigma.push_back(static_cast<float>(random.uniform(0.0, 1e-5)));
  }
  for (int i = 0; kind.region && i < kind.leaves * kind.inputs; ++i) {
    tree.region.push_back(static_cast<float>(random.uniform(-1.5, -0.5)));
    tree.region.push_back(static_cast<float>(random.uniform(0.5, 1.5)));
  }
}

/// A random leaf is split until there are enough; parents stand before children.
inline format::Tree random_tree(tests::Random& random, const TreeKind& kind) {
  struct Slot {
    int parent;
    bool high;
    int depth;
  };
  format::Tree out;
  out.degree = static_cast<std::uint8_t>(kind.degree);
  std::vector<Slot> open{{-1, false, 0}};
  const auto hang = [&](const Slot& slot, int child) {
    if (slot.parent < 0) return;
    auto& parent = out.nodes[static_cast<std::size_t>(slot.parent)];
    (slot.high ? parent.high : parent.low) = static_cast<std::int16_t>(child);
  };
  while (static_cast<int>(open.size()) < kind.leaves) {
    Slot& slot = open[static_cast<std::size_t>(random.below(static_cast<int>(open.size())))];
    const int index = static_cast<int>(out.nodes.size());
    out.nodes.push_back({.threshold = random.uniform(-1, 1)});
    hang(slot, index);
    slot = {index, false, slot.depth + 1};
    open.push_back({index, true, slot.depth});
    const int input = random.below(kind.inputs);
    if (!kind.oblique) out.nodes.back().input = static_cast<std::uint16_t>(input);
    if (kind.widest > 0.0)
      out.blend_half_width.push_back(
          std::exp(random.uniform(std::log(kind.narrowest), std::log(kind.widest))));
    double length = 0.0;
    std::vector<double> direction;
    for (int i = 0; kind.oblique && i < kind.inputs; ++i) {
      direction.push_back(random.uniform(-1, 1));
      length += std::abs(direction.back());
    }
    for (double x : direction) out.directions.push_back(x / length);
  }
  for (std::size_t leaf = 0; leaf < open.size(); ++leaf) {
    hang(open[leaf], ~static_cast<int>(leaf));
    out.depth = std::max(out.depth, static_cast<std::uint16_t>(open[leaf].depth));
  }
  add_leaves(random, kind, out);
  return out;
}

inline std::vector<double> random_point(tests::Random& random, int inputs) {
  std::vector<double> out;
  for (int i = 0; i < inputs; ++i) out.push_back(random.uniform(-1, 1));
  return out;
}

}  // namespace plumb::test
