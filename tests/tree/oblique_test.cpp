// SPDX-License-Identifier: Apache-2.0
// Splits along weighted sums of inputs.
#include <gtest/gtest.h>

#include <cstdio>

#include "plumb/runtime/detail/tree.hpp"
#include "tests/tree/tree_data.hpp"
#include "tree/growth.hpp"

namespace plumb::offline {
namespace {

using namespace tree_data;

struct Folded {
  Samples u, y;
};

/// Two planes that meet where a direction of the first two of three inputs says `at`.
Folded folded(double along_0, double along_1, double at, double noise) {
  Random random(1);
  Folded out{uniform(1500, 3, -1, 1, random), Samples(1500, 1)};
  for (Eigen::Index i = 0; i < 1500; ++i)
    out.y(i, 0) = 1e-3 * std::abs(along_0 * out.u(i, 0) + along_1 * out.u(i, 1) - at) +
                  2e-4 * out.u(i, 2) + noise * gauss(random);
  return out;
}

void expect_directions_of_length_one(const format::Tree& tree) {
  ASSERT_EQ(tree.directions.size(), 3 * tree.nodes.size());
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    double length = 0.0;
    for (std::size_t i = 0; i < 3; ++i) length += std::abs(tree.directions[3 * n + i]);
    EXPECT_NEAR(length, 1.0, 1e-12);
    EXPECT_EQ(tree.nodes[n].input, 0);
  }
}

TEST(ObliqueSplit, FindsAFoldThatNoAxisCan) {
  const Folded data = folded(1.0, 1.0, 0.0, 0.0);
  const GrownTree axes = grow(data.u, data.y, {.max_leaves = 2});
  const GrownTree oblique = grow(data.u, data.y, {.max_leaves = 2, .splits = SplitKind::kOblique});
  std::printf("RSS %.2e, along axes %.2e, oblique %.2e m^2\n", axes.rss(1), axes.rss(2),
              oblique.rss(2));
  EXPECT_GT(axes.rss(2), 0.25 * axes.rss(1));
  EXPECT_LT(oblique.rss(2), 1e-3 * axes.rss(2));
  const format::Tree tree = oblique.cut(2);
  expect_directions_of_length_one(tree);
  EXPECT_NEAR(tree.directions[0], 0.5, 0.005);
  EXPECT_NEAR(tree.directions[1], 0.5, 0.005);
  EXPECT_NEAR(tree.nodes[0].threshold, 0.0, 0.005);
}

TEST(ObliqueSplit, FindsWhereAndInWhichDirectionAFoldLiesThroughNoise) {
  const Folded data = folded(1.0, -0.5, 0.3, 2e-5);
  const format::Tree tree =
      grow(data.u, data.y, {.max_leaves = 2, .splits = SplitKind::kOblique}).cut(2);
  expect_directions_of_length_one(tree);
  EXPECT_NEAR(tree.directions[0], 2.0 / 3.0, 0.02);
  EXPECT_NEAR(tree.directions[1], -1.0 / 3.0, 0.02);
  EXPECT_NEAR(tree.directions[2], 0.0, 0.02);
  EXPECT_NEAR(tree.nodes[0].threshold, 0.2, 0.02);
}

TEST(ObliqueSplit, IsNotTakenWhereAnAxisDoesAsWell) {
  const Folded data = folded(1.0, 0.0, 0.2, 2e-5);
  const GrownTree tree = grow(data.u, data.y, {.max_leaves = 2, .splits = SplitKind::kOblique});
  EXPECT_TRUE(tree.cut(2).directions.empty());
  EXPECT_EQ(tree.cut(2), grow(data.u, data.y, {.max_leaves = 2}).cut(2));
}

/// Leaf of row i by the directions as the model file defines them.
int leaf_of(const format::Tree& tree, const Samples& u, Eigen::Index i) {
  int at = 0;
  while (at >= 0) {
    double x = 0.0;
    for (Eigen::Index k = 0; k < 3; ++k)
      x += tree.directions[static_cast<std::size_t>(3 * at + k)] * u(i, k);
    const auto& node = tree.nodes[static_cast<std::size_t>(at)];
    at = x <= node.threshold ? node.low : node.high;
  }
  return ~at;
}

TEST(ObliqueSplit, IsReadByTheRuntimeAsItWasTrained) {
  const Folded data = folded(1.0, 1.0, 0.1, 1e-5);
  const GrownTree grown = grow(data.u, data.y, {.max_leaves = 12, .splits = SplitKind::kOblique});
  for (int leaves = 2; leaves <= grown.leaves(); ++leaves) {
    const format::Tree tree = grown.cut(leaves);
    expect_directions_of_length_one(tree);
    const auto cells = grown.leaf_cells(grown.first_splits(leaves));
    const TreeView view(tree, 3);
    std::vector<int> landed(static_cast<std::size_t>(leaves), 0);
    for (Eigen::Index i = 0; i < data.u.rows(); ++i) {
      const SampleRow row(data.u, i);
      const int leaf = leaf_of(tree, data.u, i);
      ASSERT_EQ(view.leaf(row.span()), leaf);
      const int cell = cells[static_cast<std::size_t>(leaf)];
      EXPECT_NEAR(view.evaluate(row.span()), grown.predict(cell, row.span(), 0), 1e-17);
      ++landed[static_cast<std::size_t>(leaf)];
    }
    for (std::size_t leaf = 0; leaf < landed.size(); ++leaf)
      EXPECT_EQ(landed[leaf], grown.cells[static_cast<std::size_t>(cells[leaf])].model.samples);
  }
}

}  // namespace
}  // namespace plumb::offline
