// SPDX-License-Identifier: Apache-2.0
// The rules beside figures worked out by hand; the F distribution in closed form.
#include "tree/stop_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "numbers/tails.hpp"

namespace plumb::offline {
namespace {

/// y = |u| and a pattern of size 0.1 that no line on either side sees. About one line, slope 0 and
/// height 0.4, the RSS is 0.4 + 0.08; of two lines it is 0.08. N = 8, d = 2.
struct Fold {
  Samples u{8, 1}, y{8, 1};
  Fold() {
    u << -0.7, -0.5, -0.3, -0.1, 0.1, 0.3, 0.5, 0.7;
    const double pattern[] = {0.1, -0.1, -0.1, 0.1};
    for (int i = 0; i < 8; ++i) y(i, 0) = std::abs(u(i, 0)) + pattern[i % 4];
  }
  GrownTree tree() const { return grow(u, y, {.max_leaves = 8, .min_samples = 4}); }
};

int standing(const Splits& splits) {
  int out = 0;
  for (char split : splits) out += split;
  return out;
}

TEST(StopRules, StandOnTheSumsOfSquaresThatFollowByHand) {
  const GrownTree tree = Fold().tree();
  ASSERT_EQ(tree.leaves(), 2);
  EXPECT_NEAR(tree.rss(1), 0.48, 1e-15);
  EXPECT_NEAR(tree.rss(2), 0.08, 1e-15);
}

TEST(StopRules, StopAtTheGainOfTheNextSplit) {
  const GrownTree tree = Fold().tree();  // it gains 0.4 of 0.48
  EXPECT_EQ(leaves_at_gain(tree, 0.4 / 0.48 - 1e-9), 2);
  EXPECT_EQ(leaves_at_gain(tree, 0.4 / 0.48 + 1e-9), 1);
}

/// delta = 0.48 / 6 - 0.08 / 4 = 0.06, of a variance of 0.08: share^2 = 0.75.
TEST(StopRules, StopWhereTheVarianceFallsByLessThanDelta) {
  const GrownTree tree = Fold().tree();
  EXPECT_EQ(standing(stop_by_delta(tree, std::sqrt(0.75) - 1e-9)), 1);
  EXPECT_EQ(standing(stop_by_delta(tree, std::sqrt(0.75) + 1e-9)), 0);
}

/// F = 0.4 * 4 / (2 * 0.08) = 10 with 2 and 4 degrees of freedom: p = (1 + 2 F / 4)^-2 = 1 / 36,
/// charged for 8 rows of one input.
TEST(StopRules, StopWhereChowsTestFindsOneModelEnough) {
  const GrownTree tree = Fold().tree();
  EXPECT_NEAR(ln_f_tail(10.0, 2.0, 4.0), -std::log(36.0), 1e-9);
  EXPECT_EQ(standing(stop_by_chow(tree, 8.0 / 36.0 + 1e-9)), 1);
  EXPECT_EQ(standing(stop_by_chow(tree, 8.0 / 36.0 - 1e-9)), 0);
}

/// A root that gains little, a low side that gains much, a high side that gains nothing.
GrownTree hidden_gain() {
  GrownTree out;
  out.inputs = 3;
  out.cells.resize(7);
  const auto cell = [&](int at, double rss, int samples, int low) {
    auto& c = out.cells[static_cast<std::size_t>(at)];
    c.model.rss = rss;
    c.model.samples = samples;
    if (low < 0) return;
    c.low = low, c.high = low + 1, c.input = 0;
    c.split_at = static_cast<int>(out.split_order.size()) + 1;
    out.split_order.push_back(at);
  };
  cell(0, 100.0, 80, 1);
  cell(1, 50.0, 40, 3);
  cell(2, 49.0, 40, 5);
  cell(3, 1.0, 20, -1);
  cell(4, 1.0, 20, -1);
  cell(5, 24.5, 20, -1);
  cell(6, 24.5, 20, -1);
  return out;
}

TEST(StopRules, LetNoSplitStandWhoseParentDoesNot) {
  const GrownTree tree = hidden_gain();
  // Root: 100 / 76 - 99 / 72 < 0. Low: 50 / 36 - 2 / 32 = 1.33, the variance being 100 / 76 = 1.32.
  EXPECT_EQ(stop_by_delta(tree, 0.5), Splits(7, 0));
  EXPECT_EQ(stop_by_chow(tree, 0.05), Splits(7, 0));
  EXPECT_EQ(leaves_at_gain(tree, 0.02), 1);
}

TEST(StopRules, SplitOnlyTheSideThatGains) {
  GrownTree tree = hidden_gain();
  tree.cells[0].model.rss = 1000.0;
  const Splits expected{1, 1, 0, 0, 0, 0, 0};
  // Variance 1000 / 76 = 13.2; root 11.8, low 1.33, high 49 / 36 - 49 / 32 < 0.
  EXPECT_EQ(stop_by_delta(tree, 0.3), expected);
  EXPECT_EQ(stop_by_chow(tree, 0.05), expected);
  EXPECT_EQ(stop_by_delta(tree, 0.4), (Splits{1, 0, 0, 0, 0, 0, 0}));
}

/// P(F > f) with 4 and b degrees of freedom is x^p (1 + p (1 - x)), p = b / 2, x = b / (b + 4 f).
/// Root: N = 80, three inputs, d = 4, F = (1000 - 99) 72 / (4 * 99).
TEST(StopRules, ChargeChowsTestForEveryRowAndInputThatWasTried) {
  GrownTree tree = hidden_gain();
  for (const double before : {110.0, 130.0, 200.0}) {
    tree.cells[0].model.rss = before;
    const double f = (before - 99.0) * 72.0 / (4.0 * 99.0), x = 72.0 / (72.0 + 4.0 * f);
    const double p = std::pow(x, 36.0) * (1.0 + 36.0 * (1.0 - x));
    EXPECT_NEAR(ln_f_tail(f, 4.0, 72.0), std::log(p), 1e-9 * std::abs(std::log(p)));
    EXPECT_EQ(stop_by_chow(tree, 240.0 * p * (1.0 + 1e-6))[0], 1) << before;
    EXPECT_EQ(stop_by_chow(tree, 240.0 * p * (1.0 - 1e-6))[0], 0) << before;
  }
}

TEST(StopRules, SayNothingOfNoTree) {
  EXPECT_EQ(leaves_at_gain({}, 0.02), 0);
  EXPECT_TRUE(stop_by_delta({}, 0.1).empty());
  EXPECT_TRUE(stop_by_chow({}, 0.05).empty());
}

}  // namespace
}  // namespace plumb::offline
