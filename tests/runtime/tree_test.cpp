// SPDX-License-Identifier: Apache-2.0
// Against a recursive walk over random trees.
#include "plumb/runtime/detail/tree.hpp"
#include "plumb/runtime/detail/trained_domain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/random_numbers.hpp"

namespace plumb {
namespace {

struct Built {
  format::Tree tree;
  int inputs = 0;
};

/// Splits a random leaf until there are enough; parents stand before children.
Built random_tree(tests::Random& random, int leaves) {
  Built out;
  out.inputs = 1 + random.below(format::kMaxJoints);
  struct Slot {
    int parent;
    bool high;
    int depth;
  };
  std::vector<Slot> open{{-1, false, 0}};
  while (static_cast<int>(open.size()) < leaves) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(open.size())));
    const Slot slot = open[at];
    const auto index = static_cast<std::int16_t>(out.tree.nodes.size());
    out.tree.nodes.push_back({.threshold = random.uniform(-1, 1),
                              .input = static_cast<std::uint16_t>(random.below(out.inputs)),
                              .low = 0,
                              .high = 0});
    if (slot.parent >= 0)
      (slot.high ? out.tree.nodes[slot.parent].high : out.tree.nodes[slot.parent].low) = index;
    open[at] = {index, false, slot.depth + 1};
    open.push_back({index, true, slot.depth + 1});
  }
  for (std::size_t leaf = 0; leaf < open.size(); ++leaf) {
    const Slot slot = open[leaf];
    const auto child = static_cast<std::int16_t>(~static_cast<int>(leaf));
    if (slot.parent >= 0)
      (slot.high ? out.tree.nodes[slot.parent].high : out.tree.nodes[slot.parent].low) = child;
    out.tree.depth = static_cast<std::uint16_t>(std::max<int>(out.tree.depth, slot.depth));
    for (int i = 0; i <= out.inputs; ++i)
      out.tree.coefficients.push_back(random.uniform(-1e-4, 1e-4));
    const double bound = random.uniform(1e-5, 2e-4);
    out.tree.bounds.insert(out.tree.bounds.end(), {-bound, bound});
  }
  return out;
}

int walk(const format::Tree& tree, const std::vector<double>& u) {
  int at = tree.nodes.empty() ? ~0 : 0;
  while (at >= 0)
    at = u[tree.nodes[at].input] <= tree.nodes[at].threshold ? tree.nodes[at].low
                                                             : tree.nodes[at].high;
  return ~at;
}

TEST(TreeView, FindsTheLeafThatARecursiveWalkFindsAndItsClampedValue) {
  tests::Random random(1);
  for (int k = 0; k < 300; ++k) {
    const Built built = random_tree(random, 1 + random.below(200));
    const TreeView view(built.tree, built.inputs);
    for (int i = 0; i < 200; ++i) {
      std::vector<double> u;
      for (int j = 0; j < built.inputs; ++j) u.push_back(random.uniform(-1, 1));
      const int leaf = walk(built.tree, u);
      ASSERT_EQ(view.leaf(u), leaf);
      const double* w = &built.tree.coefficients[leaf * (built.inputs + 1)];
      long double y = w[0];
      for (int j = 0; j < built.inputs; ++j) y += static_cast<long double>(w[j + 1]) * u[j];
      const double bound = built.tree.bounds[2 * leaf + 1];
      ASSERT_NEAR(view.evaluate(u), std::clamp(static_cast<double>(y), -bound, bound), 1e-18);
    }
  }
}

TEST(TreeView, OnTheThresholdGoesLow) {
  format::Tree tree;
  tree.depth = 1;
  tree.nodes = {{0.25, 0, ~0, ~1, 0}};
  tree.coefficients = {1e-3, 0.0, 2e-3, 0.0};
  tree.bounds = {-1.0, 1.0, -1.0, 1.0};
  const TreeView view(tree, 1);
  EXPECT_EQ(view.evaluate(std::vector<double>{0.25}), 1e-3);
  EXPECT_EQ(view.evaluate(std::vector<double>{std::nextafter(0.25, 1.0)}), 2e-3);
}

TEST(TreeView, NoLeavesMeanNoCorrectionAndOneLeafAPlainLinearModel) {
  EXPECT_EQ(TreeView(format::Tree{}, 3).evaluate(std::vector<double>{0, 0, 0}), 0.0);
  format::Tree line;
  line.coefficients = {1e-5, 2e-5};
  line.bounds = {-1.0, 1.0};
  EXPECT_DOUBLE_EQ(TreeView(line, 1).evaluate(std::vector<double>{0.5}), 2e-5);
}

TEST(TreeView, NaNNeverLeavesTheTreeNorItsBounds) {
  tests::Random random(2);
  for (int k = 0; k < 200; ++k) {
    const Built built = random_tree(random, 1 + random.below(100));
    const std::vector<double> u(built.inputs, std::numeric_limits<double>::quiet_NaN());
    const double y = TreeView(built.tree, built.inputs).evaluate(u);
    EXPECT_TRUE(std::isfinite(y));
    EXPECT_LE(std::abs(y), 2e-4);
  }
}

TEST(TrainedDomain, WeighsOneInsideZeroBeyondTheFadeAndHalfwayInTheMiddle) {
  const TrainedDomain domain({{-1.0, 0.0}, {1.0, 4.0}, 0.1});
  const auto weight = [&](double a, double b) {
    std::vector<double> u(2);
    return domain.normalise(std::vector<double>{a, b}, u);
  };
  EXPECT_EQ(weight(0.0, 2.0), 1.0);
  EXPECT_EQ(weight(-1.0, 4.0), 1.0);
  EXPECT_NEAR(weight(1.1, 2.0), 0.5, 1e-12);   // 0.1 beyond a span of 2, fade 0.1 spans
  EXPECT_NEAR(weight(0.0, -0.2), 0.5, 1e-12);  // 0.2 beyond a span of 4
  EXPECT_EQ(weight(1.3, 2.0), 0.0);
  EXPECT_EQ(weight(-50.0, 900.0), 0.0);
}

TEST(TrainedDomain, NormalisesToMinusOneToOneAndClampsOutside) {
  const TrainedDomain domain({{-1.0, 0.0}, {1.0, 4.0}, 0.1});
  std::vector<double> u(2);
  domain.normalise(std::vector<double>{0.5, 1.0}, u);
  EXPECT_DOUBLE_EQ(u[0], 0.5);
  EXPECT_DOUBLE_EQ(u[1], -0.5);
  domain.normalise(std::vector<double>{9.0, -9.0}, u);
  EXPECT_EQ(u[0], 1.0);
  EXPECT_EQ(u[1], -1.0);
}

}  // namespace
}  // namespace plumb
