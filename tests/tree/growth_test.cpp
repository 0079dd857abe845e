// SPDX-License-Identifier: Apache-2.0
#include "tree/growth.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "plumb/runtime/detail/tree.hpp"
#include "tests/tree/tree_data.hpp"
#include "tests/yardstick.hpp"

namespace plumb::offline {
namespace {

using namespace tree_data;

std::vector<std::vector<int>> rows_by_leaf(const format::Tree& tree, const Samples& u) {
  std::vector<std::vector<int>> out(tree.bounds.size() / 2);
  for (Eigen::Index i = 0; i < u.rows(); ++i)
    out[land(tree, u, i).leaf].push_back(static_cast<int>(i));
  return out;
}

double condition(const Samples& u, const std::vector<int>& rows) {
  Eigen::MatrixXd A(rows.size(), u.cols() + 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    A(i, 0) = 1.0;
    A.row(i).tail(u.cols()) = u.row(rows[i]);
  }
  const auto s = Eigen::JacobiSVD<Eigen::MatrixXd>(A).singularValues();
  return s[0] / s[s.size() - 1];
}

double rss_of(const format::Tree& tree, const Samples& u, const Eigen::VectorXd& y) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    const double error = y[i] - evaluate(tree, u, i);
    sum += error * error;
  }
  return sum;
}

struct Noisy {
  Samples u;
  Eigen::VectorXd y;
};

Noisy noisy(int rows, int inputs, std::uint64_t seed) {
  Random random(seed);
  Noisy out;
  out.u = uniform(rows, inputs, -1, 1, random);
  out.y = smooth(out.u, 1e-3);
  for (double& value : out.y) value += 1e-4 * gauss(random);
  return out;
}

TEST(TreeGrowth, EveryLeafOfEverySizeHasFullRankEnoughSamplesAndTheBoundsItSaw) {
  for (const auto& u : {grid(20, 2), grid(7, 3), noisy(700, 4, 1).u}) {
    const Eigen::VectorXd y = smooth(u, 1e-3);
    const GrownTree tree = grow(u, y, {.max_leaves = 200, .min_samples = 2 * (int(u.cols()) + 1)});
    for (int k : {1, 2, 17, tree.leaves()}) {
      const format::Tree cut = tree.cut(k);
      const auto leaves = rows_by_leaf(cut, u);
      ASSERT_EQ(static_cast<int>(leaves.size()), k);
      for (int leaf = 0; leaf < k; ++leaf) {
        EXPECT_GE(leaves[leaf].size(), 2u * (u.cols() + 1));
        EXPECT_LT(condition(u, leaves[leaf]), 1e7);
        double low = 1e9, high = -1e9;
        for (int row : leaves[leaf]) low = std::min(low, y[row]), high = std::max(high, y[row]);
        EXPECT_EQ(cut.bounds[2 * leaf], low);
        EXPECT_EQ(cut.bounds[2 * leaf + 1], high);
      }
    }
  }
}

TEST(TreeGrowth, EverySizeIsAWellFormedTreeThatTheRuntimeReadsTheSameWay) {
  const auto [u, y] = noisy(900, 3, 2);
  const GrownTree tree = grow(u, y, {.max_leaves = 60});
  for (int k = 1; k <= tree.leaves(); ++k) {
    const format::Tree cut = tree.cut(k);
    ASSERT_EQ(static_cast<int>(cut.nodes.size()), k - 1);
    ASSERT_EQ(static_cast<int>(cut.coefficients.size()), 4 * k);
    for (int node = 0; node < k - 1; ++node)
      for (int child : {cut.nodes[node].low, cut.nodes[node].high})
        EXPECT_TRUE(child > node || (child < 0 && ~child < k));
    int deepest = 0;
    for (Eigen::Index i = 0; i < u.rows(); ++i) {
      deepest = std::max(deepest, land(cut, u, i).compares);
      const std::array<double, 3> row{u(i, 0), u(i, 1), u(i, 2)};
      const double runtime = TreeView(cut, 3).evaluate(row);
      EXPECT_NEAR(runtime, evaluate(cut, u, i), 1e-17);
    }
    EXPECT_EQ(deepest, cut.depth);
  }
  EXPECT_TRUE(tree.cut(0).bounds.empty());
}

TEST(TreeGrowth, TheStatedRssIsThatOfTheTreeAndFallsWithEverySplit) {
  const auto [u, y] = noisy(800, 2, 3);
  const GrownTree tree = grow(u, y, {.max_leaves = 50});
  for (int k = 1; k <= tree.leaves(); ++k) {
    format::Tree cut = tree.cut(k);
    EXPECT_LE(rss_of(cut, u, y), tree.rss(k)) << "clamping to what was seen can only help here";
    for (std::size_t i = 0; i < cut.bounds.size(); ++i) cut.bounds[i] = i % 2 == 0 ? -1.0 : 1.0;
    EXPECT_NEAR(rss_of(cut, u, y) / tree.rss(k), 1.0, 1e-9);
    if (k > 1) {
      EXPECT_LT(tree.rss(k), tree.rss(k - 1));
    }
  }
}

TEST(TreeGrowth, TheOrderOfTheRowsDoesNotChangeABit) {
  Random random(5);
  for (const auto& u : {noisy(500, 3, 4).u, grid(8, 3)}) {
    Eigen::VectorXd y = smooth(u, 1e-3);
    for (double& value : y) value += 1e-4 * gauss(random);
    const format::Tree first = grow(u, y, {}).cut(15);
    for (int run = 0; run < 5; ++run) {
      const auto order = shuffled(static_cast<int>(u.rows()), random);
      EXPECT_EQ(first, grow(permuted(u, order), permuted(y, order), {}).cut(15));
    }
  }
}

TEST(TreeGrowth, TheUnitOfLengthChangesNoSplit) {
  const auto [u, y] = noisy(600, 3, 6);
  const format::Tree metres = grow(u, y, {}).cut(25);
  for (double unit : {1e3, 1e6, 1e-3}) {
    const format::Tree other = grow(u, unit * y, {}).cut(25);
    EXPECT_EQ(metres.nodes, other.nodes);
    for (std::size_t i = 0; i < metres.coefficients.size(); ++i)
      EXPECT_NEAR(other.coefficients[i], unit * metres.coefficients[i], unit * 1e-15);
  }
}

TEST(TreeGrowth, AnExactlyLinearErrorNeedsOneLeaf) {
  Random random(7);
  const Samples u = uniform(500, 6, -1, 1, random);
  Eigen::VectorXd y = Eigen::VectorXd::Constant(500, 2e-4);
  for (int k = 0; k < 6; ++k) y += 1e-4 * (k + 1) * u.col(k);
  const GrownTree tree = grow(u, y, {});
  EXPECT_EQ(tree.leaves(), 1);
  EXPECT_NEAR(tree.cells[0].model.w[6], 6e-4, 1e-16);
}

TEST(TreeGrowth, JointsThatStandStillOrFollowAnotherAreLeftOut) {
  auto [u, y] = noisy(400, 4, 8);
  const Samples two = u.leftCols(2);
  y = smooth(two, 1e-3);
  u.col(2).setConstant(0.25);
  u.col(3) = (0.5 * u.col(0) - 0.25 * u.col(1)).array() + 0.1;
  const GrownTree all = grow(u, y, {.min_samples = 9});
  const GrownTree some = grow(two, y, {.min_samples = 9});
  ASSERT_EQ(all.leaves(), some.leaves());
  EXPECT_EQ(all.cut(10).nodes, some.cut(10).nodes);
  for (const TreeCell& cell : all.cells) {
    EXPECT_EQ(cell.model.w[3], 0.0);
    EXPECT_EQ(cell.model.w[4], 0.0);
  }
}

TEST(TreeGrowth, ValuesThatDifferByRoundingAreNeverSeparated) {
  Random random(9);
  Samples u = grid(12, 2);
  for (Eigen::Index i = 0; i < u.rows(); ++i) u(i, 0) += 1e-12 * (random.unit() - 0.5);
  const format::Tree tree = grow(u, smooth(u, 1e-3), {.min_samples = 6}).cut(10);
  for (const auto& node : tree.nodes)
    EXPECT_GT((u.col(node.input).array() - node.threshold).abs().minCoeff(), 0.05);
}

TEST(TreeGrowth, TooFewSamplesGiveNoTree) {
  const auto [u, y] = noisy(20, 6, 10);
  EXPECT_EQ(grow(u, y, {}).leaves(), 0);
  EXPECT_EQ(grow(u, y, {.min_samples = 11}).leaves(), 1);
}

TEST(TreeGrowth, TwelveThousandSixAxisPosesGrowTo256LeavesInAQuarterOfASecond) {
  const auto [u, y] = noisy(12000, 6, 11);
  const double start = tests::processor_s();
  const GrownTree tree = grow(u, y, {.max_leaves = 256});
  const double seconds = tests::processor_s() - start;
  EXPECT_EQ(tree.leaves(), 256);
  std::cout << "12000 x 6 to 256 leaves: " << 1e3 * seconds << " ms\n";
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(seconds, 0.25 * tests::times_slower());
#endif
}

}  // namespace
}  // namespace plumb::offline
