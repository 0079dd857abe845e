// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <optional>

#include "tests/tree/tree_data.hpp"
#include "tree/growth.hpp"

namespace plumb::offline {
namespace {

using namespace tree_data;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using Rows = std::vector<int>;

struct Reference {
  LongVector w;
  double rss = 0.0;
  bool full_rank = false;
};

/// Householder QR in extended precision, on these rows alone.
Reference least_squares(const Samples& u, const Eigen::VectorXd& y, const Rows& rows) {
  LongMatrix A(rows.size(), u.cols() + 1);
  LongVector b(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    A(i, 0) = 1.0L;
    for (Eigen::Index k = 0; k < u.cols(); ++k) A(i, k + 1) = u(rows[i], k);
    b[i] = y[rows[i]];
  }
  if (A.rows() < A.cols()) return {};
  Eigen::ColPivHouseholderQR<LongMatrix> qr(A);
  qr.setThreshold(1e-9L);
  Reference out;
  out.full_rank = qr.rank() == A.cols();
  out.w = qr.solve(b);
  out.rss = static_cast<double>((b - A * out.w).squaredNorm());
  return out;
}

struct BruteSplit {
  int input;
  double threshold, rss;
  Rows low, high;
};

/// Every threshold between neighbouring values of every input, each side solved from scratch.
std::optional<BruteSplit> best_by_force(const Samples& u, const Eigen::VectorXd& y,
                                        const Rows& rows, std::size_t min_samples) {
  std::optional<BruteSplit> best;
  for (int input = 0; input < u.cols(); ++input) {
    std::vector<double> values;
    for (int row : rows) values.push_back(u(row, input));
    std::sort(values.begin(), values.end());
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (values[i] - values[i - 1] < 1e-9) continue;
      BruteSplit split{input, (values[i] + values[i - 1]) / 2, 0.0, {}, {}};
      for (int row : rows)
        (u(row, input) <= split.threshold ? split.low : split.high).push_back(row);
      if (split.low.size() < min_samples || split.high.size() < min_samples) continue;
      const auto a = least_squares(u, y, split.low), b = least_squares(u, y, split.high);
      if (!a.full_rank || !b.full_rank) continue;
      split.rss = a.rss + b.rss;
      if (!best || split.rss < best->rss * (1 - 1e-11)) best = split;
    }
  }
  return best;
}

struct Figures {
  double worst_rss = 0.0, worst_w = 0.0;
  int cells = 0;
};

/// Follows the grown tree from the root and solves every cell again by force.
void compare(const GrownTree& tree, const Samples& u, const Eigen::VectorXd& y, int min_samples,
             int at, const Rows& rows, Figures& out) {
  const TreeCell& cell = tree.cells[at];
  const Reference reference = least_squares(u, y, rows);
  ++out.cells;
  ASSERT_EQ(cell.model.samples, static_cast<int>(rows.size()));
  out.worst_rss = std::max(out.worst_rss, std::abs(cell.model.rss - reference.rss) / reference.rss);
  for (Eigen::Index k = 0; k <= u.cols(); ++k)
    out.worst_w =
        std::max(out.worst_w, std::abs(cell.model.w[k] - static_cast<double>(reference.w[k])) /
                                  static_cast<double>(reference.w.norm()));
  const auto split = best_by_force(u, y, rows, min_samples);
  if (!cell.is_split()) {
    EXPECT_FALSE(split) << "a leaf of a fully grown tree could still be split";
    return;
  }
  ASSERT_TRUE(split);
  EXPECT_EQ(cell.input, split->input);
  EXPECT_NEAR(cell.threshold, split->threshold, 1e-15);
  compare(tree, u, y, min_samples, cell.low, split->low, out);
  compare(tree, u, y, min_samples, cell.high, split->high, out);
}

Figures compare_grown_out(const Samples& u, const Eigen::VectorXd& y, int min_samples) {
  const GrownTree tree = grow(u, y, {.max_leaves = 4096, .min_samples = min_samples});
  Figures out;
  compare(tree, u, y, min_samples, 0, numbered(static_cast<int>(u.rows())), out);
  return out;
}

void expect_exact(const Figures& figures) {
  EXPECT_LT(figures.worst_rss, 1e-9);
  EXPECT_LT(figures.worst_w, 1e-9);
  std::cout << figures.cells << " cells, worst relative error: RSS " << figures.worst_rss
            << ", coefficients " << figures.worst_w << '\n';
}

TEST(TreeExactness, EverySplitAndLeafIsThatOfBruteForceOnScatteredInputs) {
  for (int inputs = 1; inputs <= 6; ++inputs) {
    Random random(inputs);
    const Samples u = uniform(130, inputs, -1, 1, random);
    Eigen::VectorXd y = smooth(u, 1e-3);
    for (double& value : y) value += 1e-5 * gauss(random);
    expect_exact(compare_grown_out(u, y, 2 * (inputs + 1)));
  }
}

TEST(TreeExactness, EverySplitAndLeafIsThatOfBruteForceOnGridsFullOfDegenerateDesigns) {
  Random random(3);
  for (const auto& u : {grid(14, 2), grid(6, 3)}) {
    Eigen::VectorXd y = smooth(u, 1e-3);
    for (double& value : y) value += 1e-6 * gauss(random);
    expect_exact(compare_grown_out(u, y, static_cast<int>(u.cols()) + 2));
  }
}

TEST(TreeExactness, AThousandTimesLargerOffsetDoesNotSpoilTheResiduals) {
  Random random(4);
  const Samples u = uniform(150, 3, -1, 1, random);
  Eigen::VectorXd y = smooth(u, 1e-3);
  for (double& value : y) value += 1.0 + 1e-5 * gauss(random);
  expect_exact(compare_grown_out(u, y, 12));
}

TEST(TreeExactness, CrowdedInputsAreAsExactAsSpreadOnes) {
  Random random(5);
  Samples u = uniform(140, 3, -1, 1, random);
  u.col(1) = (1e-3 * u.col(1)).array() + 0.7;
  u.col(2) = u.col(0) + 1e-3 * u.col(2);
  Eigen::VectorXd y = smooth(u, 1e-3);
  for (double& value : y) value += 1e-4 * gauss(random);
  const Figures figures = compare_grown_out(u, y, 12);
  expect_exact(figures);
}

TEST(TreeExactness, GrowthTakesTheLargestReductionFirst) {
  Random random(6);
  const Samples u = uniform(600, 2, -1, 1, random);
  Eigen::VectorXd y = smooth(u, 1e-3);
  const GrownTree tree = grow(u, y, {.max_leaves = 40});
  ASSERT_EQ(tree.leaves(), 40);
  const auto reduction = [&](int cell) {
    const TreeCell& c = tree.cells[cell];
    return c.model.rss - tree.cells[c.low].model.rss - tree.cells[c.high].model.rss;
  };
  for (int step = 0; step < 39; ++step)
    for (int later = step + 1; later < 39; ++later)
      if (tree.split_order[later] <= 2 * step) {
        EXPECT_GE(reduction(tree.split_order[step]), reduction(tree.split_order[later]));
      }
}

}  // namespace
}  // namespace plumb::offline
