// SPDX-License-Identifier: Apache-2.0
// The global least squares beside the same problem written down in full.
#include "tree/blended_fit.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/tree/literal_fit.hpp"
#include "tests/tree/tree_data.hpp"
#include "tree/blend.hpp"
#include "tree/growth.hpp"

namespace plumb::offline {
namespace {

using namespace tree_data;
using Vector = LiteralFit::Vector;

/// Noisy samples and a tree grown on them, halving cells, with ramps.
struct Problem {
  Samples u, y;
  format::Tree tree;

  Vector column(Eigen::Index k) const { return y.col(k).cast<long double>(); }
};

Problem problem(int rows, int inputs, int leaves, int degree, double overlap, std::uint64_t seed) {
  Random random(seed);
  Problem out;
  out.u = uniform(rows, inputs, -1, 1, random);
  out.y = Samples(rows, 2);
  out.y.col(0) = smooth(out.u, 1e-3);
  out.y.col(1) = out.u.col(0).cwiseAbs() * 1e-3;
  for (Eigen::Index k = 0; k < 2; ++k)
    for (Eigen::Index i = 0; i < rows; ++i) out.y(i, k) += 1e-5 * gauss(random);
  const GrowthSettings growth{
      .max_leaves = leaves, .min_samples = 20, .degree = degree, .min_side = 0.5};
  const GrownTree grown = grow(out.u, out.y, growth);
  EXPECT_EQ(grown.leaves(), leaves);
  out.tree = grown.cut(grown.leaves());
  add_ramps(out.tree, overlap);
  return out;
}

long double relative(const Vector& a, const Vector& b) { return (a - b).norm() / b.norm(); }

TEST(BlendedFit, SolvesTheLeastSquaresOfItsFormulaAsHouseholderDoesInLongDouble) {
  for (const int degree : {1, 2})
    for (const double overlap : {1.0, 0.4}) {
      const Problem p = problem(400, 2, 8, degree, overlap, 1);
      const BlendedFit fit(p.tree, p.u);
      const LiteralFit literal(p.tree, p.u);
      ASSERT_EQ(fit.unknowns(), literal.design.cols());
      for (const double ridge : {1e-2, 1e-4, 1e-6}) {
        const auto trees = fit.solve(p.y, ridge);
        for (Eigen::Index k = 0; k < 2; ++k) {
          const Vector y = p.column(k), expected = literal.solve(y, ridge);
          const auto error =
              relative(literal.read(trees[static_cast<std::size_t>(k)], y), expected);
          EXPECT_LT(error, 1e-9L) << degree << " " << overlap << " " << ridge;
        }
      }
    }
}

/// Coefficients that the samples hardly tell apart may differ; what the tree says may not.
TEST(BlendedFit, SaysWhatHouseholderSaysEvenWithTheLeastRidge) {
  for (const int degree : {1, 2}) {
    const Problem p = problem(400, 2, 8, degree, 1.0, 2);
    const LiteralFit literal(p.tree, p.u);
    const Vector y = p.column(0), expected = literal.design * literal.solve(y, kLeastRidge);
    const auto tree = BlendedFit(p.tree, p.u).solve(p.y, 0.0)[0];
    EXPECT_LT(relative(literal.design * literal.read(tree, y), expected), 1e-8L);
  }
}

TEST(BlendedFit, UsesNoRidgeBelowTheLeast) {
  const Problem p = problem(300, 2, 5, 1, 1.0, 3);
  const BlendedFit fit(p.tree, p.u);
  EXPECT_EQ(fit.solve(p.y, 0.0), fit.solve(p.y, kLeastRidge));
  EXPECT_NE(fit.solve(p.y, 0.0), fit.solve(p.y, 1e-6));
}

/// Zero gradient of a convex sum: there is no better tree.
void expect_no_gradient(const Problem& p) {
  constexpr double kRidge = 1e-6;
  const BlendedFit fit(p.tree, p.u);
  const LiteralFit literal(p.tree, p.u);
  ASSERT_LE((literal.phi.array() > 0.0L).rowwise().count().maxCoeff(), format::kMaxActiveLeaves);
  const Vector y = p.column(0), rest = literal.rest(y);
  const Vector c = literal.read(fit.solve(p.y, kRidge)[0], y);
  const Vector pull = literal.design.transpose() * rest;
  const Vector gradient =
      literal.design.transpose() * (rest - literal.design * c) - literal.weight_of(kRidge) * c;
  std::printf("%d unknowns: gradient %.1e of its parts\n", fit.unknowns(),
              static_cast<double>(gradient.norm() / pull.norm()));
  EXPECT_LT(gradient.norm(), 1e-10L * pull.norm());
}

TEST(BlendedFit, LeavesNoGradientWhereItsMatrixIsDense) {
  expect_no_gradient(problem(3000, 5, 60, 1, 0.5, 4));  // 360 unknowns
  expect_no_gradient(problem(2000, 3, 40, 2, 0.5, 4));  // 400
}

TEST(BlendedFit, LeavesNoGradientWhereItsMatrixIsSparse) {
  expect_no_gradient(problem(6000, 5, 160, 1, 0.25, 4));  // 960
  expect_no_gradient(problem(5000, 3, 120, 2, 0.5, 4));   // 1200
}

TEST(BlendedFit, IsTheOneModelOfTheWholeBoxUnderALargeRidge) {
  const Problem p = problem(500, 3, 9, 2, 1.0, 5);
  const LiteralFit literal(p.tree, p.u);
  const Vector whole = literal.whole_box(p.column(0));
  const auto tree = BlendedFit(p.tree, p.u).solve(p.y, 1e9)[0];
  for (std::size_t at = 0; at < tree.coefficients.size(); ++at)
    EXPECT_NEAR(tree.coefficients[at],
                static_cast<double>(whole[static_cast<Eigen::Index>(at) % literal.terms]), 1e-11);
}

TEST(BlendedFit, BoundsALeafByWhatWasSeenWhereItHasASayAndWhatSoFewSamplesMayHide) {
  const Problem p = problem(400, 2, 10, 1, 0.6, 6);
  const LiteralFit literal(p.tree, p.u);
  const auto trees = BlendedFit(p.tree, p.u).solve(p.y, 1e-6);
  for (Eigen::Index output = 0; output < 2; ++output)
    for (Eigen::Index leaf = 0; leaf < 10; ++leaf) {
      double low = 1.0, high = -1.0, seen = 0.0;
      for (Eigen::Index i = 0; i < p.u.rows(); ++i)
        if (literal.phi(i, leaf) > 0.0L) {
          seen += 1.0;
          low = std::min(low, p.y(i, output));
          high = std::max(high, p.y(i, output));
        }
      const auto& bounds = trees[static_cast<std::size_t>(output)].bounds;
      const double more = std::min(0.25, 2.0 / std::sqrt(seen)) * (high - low);
      EXPECT_DOUBLE_EQ(bounds[static_cast<std::size_t>(2 * leaf)], low - more);
      EXPECT_DOUBLE_EQ(bounds[static_cast<std::size_t>(2 * leaf + 1)], high + more);
    }
}

TEST(BlendedFit, KeepsTheStructureItWasGiven) {
  const Problem p = problem(400, 2, 10, 1, 0.6, 7);
  for (auto tree : BlendedFit(p.tree, p.u).solve(p.y, 1e-6)) {
    tree.coefficients = p.tree.coefficients;
    tree.bounds = p.tree.bounds;
    EXPECT_EQ(tree, p.tree);
  }
}

TEST(BlendedFit, FitsEachLeafByItselfToItsWeightedSamplesIfAskedTo) {
  const Problem p = problem(600, 2, 6, 1, 1.0, 8);
  const LiteralFit literal(p.tree, p.u);
  const auto tree = BlendedFit(p.tree, p.u).solve_locally(p.y)[1];
  for (Eigen::Index leaf = 0; leaf < 6; ++leaf) {
    const Vector root = literal.phi.col(leaf).cwiseSqrt();
    LiteralFit::Matrix A(p.u.rows(), 3);
    A << root, root.cwiseProduct(p.u.col(0).cast<long double>()),
        root.cwiseProduct(p.u.col(1).cast<long double>());
    const Vector w = A.colPivHouseholderQr().solve(root.cwiseProduct(p.column(1)));
    for (Eigen::Index t = 0; t < 3; ++t)
      EXPECT_NEAR(tree.coefficients[static_cast<std::size_t>(3 * leaf + t)],
                  static_cast<double>(w[t]), 1e-12);
  }
}

TEST(BlendedFit, GivesTheSameTreeInMillimetresMetresAndMicrometres) {
  for (const int degree : {1, 2}) {
    const Problem p = problem(500, 3, 12, degree, 1.0, 9);
    const BlendedFit fit(p.tree, p.u);
    const LiteralFit literal(p.tree, p.u);
    const Vector metres = literal.read(fit.solve(p.y, 1e-6)[0], p.column(0));
    for (const double unit : {1e3, 1e6}) {
      const Samples y = unit * p.y;
      const Vector other = literal.read(fit.solve(y, 1e-6)[0], y.col(0).cast<long double>());
      EXPECT_LT(relative(other / static_cast<long double>(unit), metres), 1e-9L) << unit;
    }
  }
}

}  // namespace
}  // namespace plumb::offline
