// SPDX-License-Identifier: Apache-2.0
// Ramps, the leaves that have a say under them, and trees of growing size.
#include "tree/blended_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "plumb/runtime/detail/tree.hpp"
#include "tests/runtime/random_tree.hpp"
#include "tests/tree/tree_data.hpp"
#include "tree/active_bound.hpp"
#include "tree/blend.hpp"

namespace plumb::offline {
namespace {

using namespace tree_data;

/// u0 at 0.2; below it u0 at 0; above it u1 at 0.3, and above that u0 at 0.5.
format::Tree four_splits() {
  return {
      .depth = 3,
      .nodes = {{0.2, 0, 1, 2, 0}, {0.0, 0, ~0, ~1, 0}, {0.3, 1, ~2, 3, 0}, {0.5, 0, ~3, ~4, 0}},
      .coefficients = std::vector<double>(15, 0.0),
      .bounds = std::vector<double>(10, 0.0)};
}

void expect_near(const std::vector<double>& seen, const std::vector<double>& expected) {
  ASSERT_EQ(seen.size(), expected.size());
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_NEAR(seen[i], expected[i], 1e-15) << i;
}

TEST(Ramps, ReachTheNearerWallOfTheCellTheyDivideTimesTheOverlap) {
  format::Tree tree = four_splits();
  add_ramps(tree, 1.0);
  expect_near(tree.blend_half_width, {0.8, 0.2, 0.7, 0.3});
  add_ramps(tree, 0.25);
  expect_near(tree.blend_half_width, {0.2, 0.05, 0.175, 0.075});
}

TEST(Ramps, AreNeverTooNarrowToDivideBy) {
  format::Tree tree = four_splits();
  tree.nodes[3].threshold = tree.nodes[0].threshold + 1e-12;
  add_ramps(tree, 1.0);
  EXPECT_GE(tree.blend_half_width[3], 1e-9);
}

/// Leaves with a say at u, counted without the runtime and without its limit.
int counted(const format::Tree& tree, const std::vector<double>& u, int node = 0) {
  if (node < 0) return 1;
  const auto at = static_cast<std::size_t>(node);
  double x = u[tree.nodes[at].input];
  if (!tree.directions.empty()) {
    x = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) x += tree.directions[at * u.size() + i] * u[i];
  }
  const double c = tree.nodes[at].threshold, h = tree.blend_half_width[at];
  return (x < c + h ? counted(tree, u, tree.nodes[at].low) : 0) +
         (x > c - h ? counted(tree, u, tree.nodes[at].high) : 0);
}

TEST(MostActiveLeaves, AreNeverFewerThanAnyPointOrCornerHas) {
  tests::Random random(1);
  for (int k = 0; k < 12; ++k) {
    const int inputs = 1 + random.below(6);
    const auto tree = test::random_tree(random, {.inputs = inputs,
                                                 .leaves = 2 + random.below(60),
                                                 .oblique = k % 3 == 2,
                                                 .narrowest = 0.02,
                                                 .widest = k % 2 == 0 ? 0.3 : 2.0});
    const int most = most_active_leaves(tree, inputs);
    int seen = 0;
    for (int i = 0; i < 100'000; ++i)
      seen = std::max(seen, counted(tree, test::random_point(random, inputs)));
    for (int corner = 0; corner < 1 << inputs; ++corner) {
      std::vector<double> u;
      for (int i = 0; i < inputs; ++i) u.push_back((corner >> i & 1) != 0 ? 1.0 : -1.0);
      seen = std::max(seen, counted(tree, u));
    }
    EXPECT_GE(most, seen) << k;
    EXPECT_LE(most, static_cast<int>(tree.leaves()));
  }
}

/// All places in between neighbouring edges of ramps: the arrangement of a small tree in full.
int counted_everywhere(const format::Tree& tree) {
  std::array<std::set<double>, 2> edges{{{-1.0, 1.0}, {-1.0, 1.0}}};
  for (std::size_t n = 0; n < tree.nodes.size(); ++n)
    for (double side : {-1.0, 1.0}) {
      const double edge = tree.nodes[n].threshold + side * tree.blend_half_width[n];
      edges[tree.nodes[n].input].insert(std::clamp(edge, -1.0, 1.0));
    }
  int out = 0;
  for (auto x = edges[0].begin(); std::next(x) != edges[0].end(); ++x)
    for (auto y = edges[1].begin(); std::next(y) != edges[1].end(); ++y)
      out = std::max(out, counted(tree, {0.5 * (*x + *std::next(x)), 0.5 * (*y + *std::next(y))}));
  return out;
}

TEST(MostActiveLeaves, AreExactForSmallTreesOfTwoInputs) {
  tests::Random random(2);
  int fewer = 0;
  for (int k = 0; k < 300; ++k) {
    const auto tree = test::random_tree(
        random, {.inputs = 2, .leaves = 2 + random.below(30), .narrowest = 0.01, .widest = 0.5});
    const int most = most_active_leaves(tree, 2);
    EXPECT_EQ(most, counted_everywhere(tree)) << k;
    fewer += most < static_cast<int>(tree.leaves());
  }
  EXPECT_GT(fewer, 200);
}

TEST(MostActiveLeaves, AreOneWithoutRampsAndNoneWithoutLeaves) {
  EXPECT_EQ(most_active_leaves({}, 3), 0);
  EXPECT_EQ(most_active_leaves(four_splits(), 2), 1);
}

struct Noisy {
  Samples u, y;
};

Noisy noisy(int rows, int inputs, std::uint64_t seed) {
  Random random(seed);
  Noisy out{uniform(rows, inputs, -1, 1, random), Samples(rows, 2)};
  out.y.col(0) = smooth(out.u, 1e-3);
  out.y.col(1) = smooth(-out.u, 2e-3).cwiseAbs();
  for (Eigen::Index i = 0; i < out.y.size(); ++i) out.y.data()[i] += 1e-5 * gauss(random);
  return out;
}

/// Splits by the way that leads to them, "" being the root and "-+" the high side of the low side.
std::map<std::string, std::pair<int, double>> splits_of(const format::Tree& tree) {
  std::map<std::string, std::pair<int, double>> out;
  std::vector<std::string> way(tree.nodes.size());
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const auto& node = tree.nodes[n];
    out[way[n]] = {node.input, node.threshold};
    if (node.low >= 0) way[static_cast<std::size_t>(node.low)] = way[n] + "-";
    if (node.high >= 0) way[static_cast<std::size_t>(node.high)] = way[n] + "+";
  }
  return out;
}

TEST(BlendedPath, HoldsEverySmallerTreeInEveryLarger) {
  const Noisy data = noisy(3000, 3, 1);
  BlendedPath path(data.u, data.y, {});
  std::map<std::string, std::pair<int, double>> before;
  for (const int leaves : {1, 2, 3, 5, 8, 13, 30, 70}) {
    ASSERT_TRUE(path.grow_to(leaves));
    ASSERT_EQ(path.leaves(), leaves);
    const auto trees = path.solve(1e-6);
    ASSERT_EQ(trees.size(), 2U);
    EXPECT_EQ(static_cast<int>(trees[0].leaves()), leaves);
    EXPECT_TRUE(TreeView(trees[0], 3).same_leaves(TreeView(trees[1], 3)));
    const auto splits = splits_of(trees[0]);
    EXPECT_TRUE(std::includes(splits.begin(), splits.end(), before.begin(), before.end()));
    before = splits;
  }
}

TEST(BlendedPath, StopsWhereTheSamplesCarryNoMore) {
  const Noisy data = noisy(200, 2, 2);
  BlendedPath path(data.u, data.y, {});
  EXPECT_FALSE(path.grow_to(1000));
  EXPECT_GT(path.leaves(), 3);
  EXPECT_LT(path.leaves(), 200 / 9 + 1);
  const Samples few_u = data.u.topRows(4), few_y = data.y.topRows(4);
  BlendedPath none(few_u, few_y, {});
  EXPECT_FALSE(none.grow_to(1));
  EXPECT_EQ(none.leaves(), 0);
}

/// 2^7 halved cells meet in one point, and no ramp is narrow enough there.
TEST(BlendedPath, StopsWhereTooManyCellsWouldMeetInOnePoint) {
  Random random(7);
  const Samples u = uniform(6000, 7, -1, 1, random);
  const Eigen::MatrixXd y = 1e-3 * u.cwiseAbs().rowwise().sum();
  BlendedPath path(u, y, {});
  EXPECT_FALSE(path.grow_to(128));
  EXPECT_LT(path.leaves(), 128);
  EXPECT_LE(most_active_leaves(path.solve(1e-6)[0], 7), format::kMaxActiveLeaves);
  const format::Tree before = path.solve(1e-6)[0];
  EXPECT_FALSE(path.grow_to(128)) << "and stays where it is";
  EXPECT_EQ(path.solve(1e-6)[0], before);
}

TEST(BlendedPath, NeverLetsMoreLeavesHaveASayThanTheCycleAllows) {
  tests::Random random(3);
  for (const int inputs : {2, 3, 5}) {
    const Noisy data = noisy(4000, inputs, 3);
    BlendedPath path(data.u, data.y, {});
    for (const int leaves : {90, 150}) {
      path.grow_to(leaves);
      const auto tree = path.solve(1e-6)[0];
      const int most = most_active_leaves(tree, inputs);
      EXPECT_LE(most, format::kMaxActiveLeaves);
      int seen = 0;
      for (int i = 0; i < 50'000; ++i) {
        auto u = test::random_point(random, inputs);
        for (double& x : u) x *= i % 3 == 0 ? 0.05 : 1.0;  // where halved cells meet
        seen = std::max(seen, counted(tree, u));
      }
      std::printf("%d inputs, %d leaves: at most %d have a say, %d seen\n", inputs, path.leaves(),
                  most, seen);
      EXPECT_LE(seen, most);
    }
  }
}

TEST(BlendedPath, DoesNotDependOnTheOrderOfTheRowsButForRounding) {
  const Noisy data = noisy(1500, 3, 4);
  BlendedPath path(data.u, data.y, {});
  ASSERT_TRUE(path.grow_to(25));
  const auto expected = path.solve(1e-6);
  Random random(5);
  for (int run = 0; run < 3; ++run) {
    const auto order = shuffled(1500, random);
    const Samples u = permuted(data.u, order), y = permuted(data.y, order);
    BlendedPath other(u, y, {});
    ASSERT_TRUE(other.grow_to(25));
    const auto trees = other.solve(1e-6);
    for (std::size_t output = 0; output < 2; ++output) {
      EXPECT_EQ(trees[output].nodes, expected[output].nodes);
      EXPECT_EQ(trees[output].blend_half_width, expected[output].blend_half_width);
      EXPECT_EQ(trees[output].bounds, expected[output].bounds);
      for (std::size_t i = 0; i < trees[output].coefficients.size(); ++i)
        EXPECT_NEAR(trees[output].coefficients[i], expected[output].coefficients[i], 1e-12);
    }
  }
}

TEST(BlendedPath, GrowsTheSameTreeInMillimetresMetresAndMicrometres) {
  const Noisy data = noisy(1500, 3, 6);
  BlendedPath metres(data.u, data.y, {});
  ASSERT_TRUE(metres.grow_to(40));
  const auto expected = metres.solve(1e-6)[0];
  for (const double unit : {1e3, 1e6}) {
    const Samples y = unit * data.y;
    BlendedPath other(data.u, y, {});
    ASSERT_TRUE(other.grow_to(40));
    const auto tree = other.solve(1e-6)[0];
    EXPECT_EQ(tree.nodes, expected.nodes);
    EXPECT_EQ(tree.blend_half_width, expected.blend_half_width);
    for (std::size_t i = 0; i < tree.coefficients.size(); ++i)
      EXPECT_NEAR(tree.coefficients[i] / unit, expected.coefficients[i], 1e-12);
  }
}

}  // namespace
}  // namespace plumb::offline
