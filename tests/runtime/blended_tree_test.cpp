// SPDX-License-Identifier: Apache-2.0
// Trees of every kind beside their definition in long double.
#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <numeric>

#include "plumb/runtime/detail/trained_domain.hpp"
#include "plumb/runtime/detail/tree.hpp"
#include "plumb/runtime/forward_model.hpp"
#include "tests/runtime/literal_tree.hpp"
#include "tests/runtime/random_tree.hpp"

namespace plumb {
namespace {

using test::LiteralTree;
using test::random_point;
using test::random_tree;
using test::TreeKind;

constexpr int kMost = format::kMaxActiveLeaves;

/// 1 .. 9 inputs, both degrees, oblique or not, regions or not, alternating with `k`.
TreeKind kind_of(tests::Random& random, int k, int most_leaves) {
  return {.inputs = 1 + random.below(format::kMaxJoints),
          .leaves = 1 + random.below(most_leaves),
          .degree = 1 + k % 2,
          .oblique = k / 2 % 2 == 1,
          .region = k / 4 % 2 == 1,
          .narrowest = 0.01,
          .widest = 2.0,
          .slope = 1e-4};
}

struct Checked {
  long points = 0;
  long double worst = 0.0L;  // relative to the largest number that was added
};

void compare(tests::Random& random, const TreeKind& kind, Checked& checked) {
  const format::Tree tree = random_tree(random, kind);
  const TreeView view(tree, kind.inputs);
  const LiteralTree literal(tree, kind.inputs);
  for (int i = 0; i < 50; ++i) {
    const auto u = random_point(random, kind.inputs);
    const auto said = literal.say(u);
    if (said.active > kMost) continue;
    ActiveLeaves<double> active;
    view.active<double>(u, active);
    ASSERT_EQ(active.count, said.active);
    for (int a = 0; a < active.count; ++a)
      ASSERT_NEAR(active.weight[a], static_cast<double>(literal.validity(active.leaf[a], u)),
                  1e-12);
    ASSERT_NEAR(std::accumulate(&active.weight[0], &active.weight[active.count], 0.0), 1.0, 1e-12);
    ASSERT_NEAR(view.sigma(u), static_cast<double>(said.sigma), 1e-17);
    ++checked.points;
    checked.worst =
        std::max(checked.worst, std::abs(view.evaluate(u) - literal.value(said)) / said.size);
  }
}

void report(const char* what, const Checked& checked) {
  std::printf("%s: %ld points, worst %.1e\n", what, checked.points,
              static_cast<double>(checked.worst));
}

TEST(BlendedTree, IsItsDefinitionInLongDoubleForEveryKind) {
  tests::Random random(1);
  Checked checked;
  const auto count = static_cast<int>(tests::scaled(400));
  for (int k = 0; k < count; ++k) {
    compare(random, kind_of(random, k, 200), checked);
    ASSERT_FALSE(HasFatalFailure()) << k;
  }
  report("blended", checked);
  EXPECT_GT(checked.points, 25 * count);
  EXPECT_LT(checked.worst, 1e-13L);
}

TEST(CrispTree, IsItsDefinitionInLongDoubleForEveryKind) {
  tests::Random random(2);
  Checked checked;
  const auto count = static_cast<int>(tests::scaled(400));
  for (int k = 0; k < count; ++k) {
    TreeKind kind = kind_of(random, k, 200);
    kind.widest = 0.0;
    compare(random, kind, checked);
    ASSERT_FALSE(HasFatalFailure()) << k;
  }
  report("crisp", checked);
  EXPECT_EQ(checked.points, 50 * count);
  EXPECT_LT(checked.worst, 1e-14L);
}

TEST(BlendedTree, OfOneLeafIsAPlainModelHeldHard) {
  const format::Tree line{.coefficients = {1e-5, 2e-5}, .bounds = {-1e-5, 1.5e-5}};
  EXPECT_EQ(TreeView(line, 1).evaluate(std::vector<double>{1.0}), 1.5e-5);
}

/// Half widths of 2 everywhere give each of 500 leaves a say at every point.
TEST(BlendedTree, KeepsFewLeavesASayWhateverTheHalfWidths) {
  tests::Random random(3);
  for (int k = 0; k < 40; ++k) {
    TreeKind kind = kind_of(random, k, 1);
    kind.leaves = 500;
    kind.narrowest = kind.widest = 2.0;
    const format::Tree tree = random_tree(random, kind);
    const TreeView view(tree, kind.inputs);
    const LiteralTree literal(tree, kind.inputs);
    const auto [low, high] = std::minmax_element(tree.bounds.begin(), tree.bounds.end());
    const double margin = kSoftShare * (*high - *low);
    for (int i = 0; i < 50; ++i) {
      const auto u = random_point(random, kind.inputs);
      if (i == 0) {
        EXPECT_GT(literal.say(u).active, kMost);
      }
      ActiveLeaves<double> active;
      view.active<double>(u, active);
      EXPECT_GE(active.count, 1);
      EXPECT_LE(active.count, kMost);
      double sum = 0.0;
      for (int a = 0; a < active.count; ++a) {
        EXPECT_GT(active.weight[a], 0.0);
        sum += active.weight[a];
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
      const double y = view.evaluate(u);
      EXPECT_GE(y, std::min(0.0, *low - margin));
      EXPECT_LE(y, std::max(0.0, *high + margin));
    }
  }
}

/// Coefficients a thousand times the bounds push the sum out nearly everywhere.
TEST(BlendedTree, NeverLeavesWhatItsLeavesSawByMoreThanATenthOfIt) {
  tests::Random random(4);
  long beyond = 0;
  for (int k = 0; k < 200; ++k) {
    TreeKind kind = kind_of(random, k, 100);
    kind.region = false;
    kind.slope = k % 3 == 0 ? 1e-4 : k % 3 == 1 ? 0.1 : 1000.0;
    const format::Tree tree = random_tree(random, kind);
    const TreeView view(tree, kind.inputs);
    const LiteralTree literal(tree, kind.inputs);
    for (int i = 0; i < 50; ++i) {
      auto u = random_point(random, kind.inputs);
      for (double& x : u)
        if (i % 5 == 0) x = x < 0.0 ? -1.0 : 1.0;
      const auto said = literal.say(u);
      if (tree.leaves() < 2 || said.active > kMost) continue;
      const double y = view.evaluate(u);
      const auto low = static_cast<double>(said.low), high = static_cast<double>(said.high);
      const double margin = kSoftShare * (high - low) + 1e-18;
      ASSERT_TRUE(y >= low - margin && y <= high + margin) << y << " " << low << " " << high;
      beyond += y < low || y > high;
    }
  }
  EXPECT_GT(beyond, 1000);
}

/// A line through the box, u(t) = from + t along, t in 0 .. 1.
struct Line {
  std::vector<double> from, along;
  std::vector<double> at(double t) const {
    std::vector<double> out(from);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += t * along[i];
    return out;
  }
};

Line random_line(tests::Random& random, int inputs) {
  Line out{random_point(random, inputs), random_point(random, inputs)};
  for (std::size_t i = 0; i < out.from.size(); ++i) out.along[i] -= out.from[i];
  return out;
}

/// Places where the second derivative may jump: edges of ramps and regions, soft limits.
class Edges {
 public:
  Edges(const format::Tree& tree, const Line& line)
      : tree_(tree), line_(line), literal_(tree, static_cast<int>(line.from.size())) {}

  std::vector<double> ramps() const {
    std::vector<double> out;
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      const auto node = static_cast<int>(n);
      const auto x0 = literal_.split_value(node, line_.at(0.0));
      const auto x1 = literal_.split_value(node, line_.at(1.0));
      for (double side : {-1.0, 1.0})
        keep((tree_.nodes[n].threshold + side * tree_.blend_half_width[n] - x0) / (x1 - x0), out);
    }
    return out;
  }

  std::vector<double> regions() const {
    std::vector<double> out;
    for (std::size_t k = 0; k < tree_.region.size(); ++k) {
      const std::size_t i = k / 2 % line_.from.size();
      const double sign = k % 2 == 0 ? -1.0 : 1.0;
      for (double beyond : {0.0, 0.1})
        keep((tree_.region[k] + sign * beyond - line_.from[i]) / line_.along[i], out);
    }
    return out;
  }

  std::vector<double> soft_limits() const {
    std::vector<double> out;
    constexpr int kSteps = 200;
    for (const bool upper : {false, true})
      for (int i = 0; i < kSteps; ++i) {
        double a = static_cast<double>(i) / kSteps, b = static_cast<double>(i + 1) / kSteps;
        const bool outside = beyond(a, upper);
        if (outside == beyond(b, upper)) continue;
        for (int halving = 0; halving < 45; ++halving)
          (beyond(0.5 * (a + b), upper) == outside ? a : b) = 0.5 * (a + b);
        keep(a, out);
      }
    return out;
  }

 private:
  bool beyond(double t, bool upper) const {
    const auto said = literal_.say(line_.at(t));
    return upper ? said.y > said.high : said.y < said.low;
  }
  static void keep(long double t, std::vector<double>& out) {
    if (t > 0.01L && t < 0.99L) out.push_back(static_cast<double>(t));
  }

  const format::Tree& tree_;
  const Line& line_;
  LiteralTree literal_;
};

/// Slopes on both sides of t, against each other and the steepest seen.
struct Smoothness {
  long edges = 0;
  double kink = 0.0, steepest = 0.0;

  void look(const TreeView& view, const Line& line, const std::vector<double>& edges_at) {
    constexpr double kStep = 1e-6;
    for (double t : edges_at) {
      const double before = view.evaluate(line.at(t - kStep)), here = view.evaluate(line.at(t));
      const double behind = view.evaluate(line.at(t + kStep));
      kink = std::max(kink, std::abs(behind - 2.0 * here + before) / kStep);
      steepest = std::max(steepest, std::abs(behind - before) / (2.0 * kStep));
      ++edges;
    }
  }
};

/// A slope that jumped would jump by as much as it is; a smooth one differs by step times
/// curvature.
TEST(BlendedTree, HasTheSameSlopeOnBothSidesOfEveryEdge) {
  tests::Random random(5);
  Smoothness ramps, regions, limits;
  for (int k = 0; k < 600; ++k) {
    TreeKind kind = kind_of(random, k, 30);
    kind.leaves += 1;
    kind.narrowest = 0.1;
    const format::Tree tree = random_tree(random, kind);
    const TreeView view(tree, kind.inputs);
    const Line line = random_line(random, kind.inputs);
    const Edges edges(tree, line);
    ramps.look(view, line, edges.ramps());
    regions.look(view, line, edges.regions());
    limits.look(view, line, edges.soft_limits());
  }
  for (const auto& [name, seen] :
       {std::pair{"ramps", ramps}, {"regions", regions}, {"limits", limits}}) {
    std::printf("%s: %ld edges, slopes up to %.1e, kink %.1e\n", name, seen.edges, seen.steepest,
                seen.kink);
    EXPECT_GT(seen.edges, 300) << name;
    EXPECT_GT(seen.steepest, 1e-4) << name;
    EXPECT_LT(seen.kink, 3e-3 * seen.steepest) << name;
  }
}

TEST(BlendedTree, SharesItsLeavesWithTreesThatDifferInTheirNumbersOnly) {
  tests::Random random(6);
  const TreeKind kind{.inputs = 3, .leaves = 9, .oblique = true, .narrowest = 0.1, .widest = 1.0};
  const format::Tree tree = random_tree(random, kind);
  const auto same = [&](const auto& change) {
    format::Tree other = tree;
    change(other);
    const TreeView a(tree, 3), b(other, 3);
    EXPECT_EQ(a.same_leaves(b), b.same_leaves(a));
    return a.same_leaves(b);
  };
  using format::Tree;
  EXPECT_TRUE(same([](Tree&) {}));
  EXPECT_TRUE(same([](Tree& t) { t.coefficients[4] += 1e-5; }));
  EXPECT_TRUE(same([](Tree& t) { t.bounds[0] -= 1e-5; }));
  EXPECT_TRUE(same([](Tree& t) { t.region.assign(54, 0.5F); }));
  EXPECT_TRUE(same([](Tree& t) { t.sigma.clear(); }));
  EXPECT_TRUE(same([](Tree& t) { t.degree = 2, t.coefficients.resize(90); }));
  EXPECT_FALSE(same([](Tree& t) { t.nodes[7].threshold += 1e-15; }));
  EXPECT_FALSE(same([](Tree& t) { std::swap(t.nodes[7].low, t.nodes[7].high); }));
  EXPECT_FALSE(same([](Tree& t) { t.blend_half_width[7] *= 1.0 + 1e-15; }));
  EXPECT_FALSE(same([](Tree& t) { t.blend_half_width.clear(); }));
  EXPECT_FALSE(same([](Tree& t) { t.directions[23] += 1e-15; }));
  EXPECT_FALSE(same([](Tree& t) { t.directions.clear(); }));
  EXPECT_FALSE(same([](Tree& t) { t = Tree{}; }));
}

/// An arm whose chain does not matter, with three trees on the same leaves.
format::Model arm_with(const std::array<format::Tree, 3>& trees, int inputs) {
  format::Model out;
  out.calibrated.joints.resize(static_cast<std::size_t>(inputs));
  out.nominal = out.calibrated;
  out.trees = trees;
  out.domain.q_min.assign(static_cast<std::size_t>(inputs), -2.0);
  out.domain.q_max.assign(static_cast<std::size_t>(inputs), 1.0);
  return out;
}

/// Says at random places what each tree says alone, to the last bit.
void expect_each_alone(tests::Random& random, const format::Model& model) {
  const ForwardModel arm(model);
  const TrainedDomain domain(model.domain);
  for (int i = 0; i < 100; ++i) {
    std::vector<double> q = random_point(random, arm.joints()), u(q.size());
    for (double& x : q) x = -0.5 + 1.6 * x;  // some of them outside
    const double weight = domain.normalise(q, u);
    const Vector3 said = arm.tree_error(q);
    for (int axis = 0; axis < 3; ++axis) {
      const TreeView view(model.trees[static_cast<std::size_t>(axis)], arm.joints());
      const double alone = view.evaluate(u) * weight;
      ASSERT_EQ(std::bit_cast<std::uint64_t>(said(axis)), std::bit_cast<std::uint64_t>(alone));
    }
  }
}

/// On the same leaves; then with a mark that nobody reads, which makes an axis' leaves its own;
/// then with other leaves for an axis.
TEST(ForwardModel, SaysTheSameBitsWithOneWalkForThreeTreesAsWithThree) {
  tests::Random random(7);
  for (int k = 0; k < 60; ++k) {
    TreeKind kind = kind_of(random, k, 60);
    if (k % 5 == 0) kind.widest = 0.0;
    kind.leaves += 1;
    std::array<format::Tree, 3> trees;
    trees.fill(random_tree(random, kind));
    for (auto& axis : trees) {
      axis.coefficients.clear();
      axis.bounds.clear();
      axis.region.clear();
      axis.sigma.clear();
      test::add_leaves(random, kind, axis);
    }
    if (k % 4 == 0) trees[static_cast<std::size_t>(k / 4 % 3)] = format::Tree{};
    auto model = arm_with(trees, kind.inputs);
    expect_each_alone(random, model);
    if (!trees[1].nodes.empty()) model.trees[1].nodes[0].reserved = 1;
    expect_each_alone(random, model);
    model.trees[1] = random_tree(random, kind);
    expect_each_alone(random, model);
  }
}

}  // namespace
}  // namespace plumb
