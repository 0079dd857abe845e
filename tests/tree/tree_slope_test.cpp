// SPDX-License-Identifier: Apache-2.0
// The runtime's tree in numbers with derivatives beside differences of what it says.
#include <gtest/gtest.h>

#include <cstdio>

#include "arm/dual.hpp"
#include "plumb/runtime/detail/tree.hpp"
#include "tests/runtime/literal_tree.hpp"
#include "tests/runtime/random_tree.hpp"

namespace plumb::offline {
namespace {

/// Every input its own direction of derivation.
std::vector<Dual> seeded(const std::vector<double>& u) {
  std::vector<Dual> out;
  for (std::size_t i = 0; i < u.size(); ++i) {
    out.emplace_back(u[i]);
    out.back().d[static_cast<Eigen::Index>(i)] = 1.0;
  }
  return out;
}

/// Of fourth order: what is left is rounding, and curvature that jumps at an edge.
double difference(const TreeView& view, std::vector<double> u, std::size_t input) {
  constexpr double kStep = 1e-4;
  const double at = u[input];
  const auto moved = [&](double steps) {
    u[input] = at + steps * kStep;
    return view.evaluate(u);
  };
  return (8.0 * (moved(1.0) - moved(-1.0)) - (moved(2.0) - moved(-2.0))) / (12.0 * kStep);
}

/// Whether an edge of a ramp, a region or a soft limit is about as near as the difference reaches.
bool near_edge(const format::Tree& tree, const std::vector<double>& u) {
  constexpr long double kNear = 1e-3L;
  const test::LiteralTree literal(tree, static_cast<int>(u.size()));
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const auto x = literal.split_value(static_cast<int>(n), u) - tree.nodes[n].threshold;
    const double h = tree.blend_half_width.empty() ? 0.0 : tree.blend_half_width[n];
    if (std::abs(std::abs(x) - h) < kNear) return true;
  }
  for (std::size_t k = 0; k < tree.region.size(); ++k) {
    const double beyond = (u[k / 2 % u.size()] - tree.region[k]) * (k % 2 == 0 ? -1.0 : 1.0);
    if (std::abs(beyond) < kNear || std::abs(beyond - 0.1) < kNear) return true;
  }
  const auto said = literal.say(u);
  const long double reach = 0.02L * said.size;
  return said.active > format::kMaxActiveLeaves || std::abs(said.y - said.low) < reach ||
         std::abs(said.y - said.high) < reach;
}

struct Checked {
  long slopes = 0;
  double worst = 0.0, steepest = 0.0;
};

void compare(tests::Random& random, const test::TreeKind& kind, Checked& checked) {
  const format::Tree tree = random_tree(random, kind);
  const TreeView view(tree, kind.inputs);
  for (int i = 0; i < 40; ++i) {
    const auto u = test::random_point(random, kind.inputs);
    const auto duals = seeded(u);
    const Dual y = view.evaluate<Dual>(duals);
    ASSERT_EQ(y.v, view.evaluate(u));
    if (near_edge(tree, u)) continue;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const double slope = y.d[static_cast<Eigen::Index>(k)];
      checked.worst = std::max(checked.worst, std::abs(slope - difference(view, u, k)));
      checked.steepest = std::max(checked.steepest, std::abs(slope));
      ++checked.slopes;
    }
  }
}

TEST(TreeSlope, IsThatOfDifferencesForEveryKindOfTree) {
  tests::Random random(11);
  Checked blended, crisp;
  for (int k = 0; k < 400; ++k) {
    test::TreeKind kind{.inputs = 1 + random.below(Dual::kLanes),
                        .leaves = 1 + random.below(40),
                        .degree = 1 + k % 2,
                        .oblique = k / 2 % 2 == 1,
                        .region = k / 4 % 2 == 1,
                        .narrowest = 0.2,
                        .widest = 1.0};
    compare(random, kind, blended);
    kind.widest = 0.0;
    compare(random, kind, crisp);
    ASSERT_FALSE(HasFatalFailure()) << k;
  }
  for (const auto& [name, checked] : {std::pair{"blended", blended}, {"crisp", crisp}}) {
    std::printf("%s: %ld slopes up to %.1e, worst difference %.1e\n", name, checked.slopes,
                checked.steepest, checked.worst);
    EXPECT_GT(checked.slopes, 5000);
    EXPECT_GT(checked.steepest, 1e-4);
    EXPECT_LT(checked.worst, 1e-6 * checked.steepest);
  }
}

}  // namespace
}  // namespace plumb::offline
