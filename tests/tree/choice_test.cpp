// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "plumb/runtime/detail/trained_domain.hpp"
#include "plumb/runtime/detail/tree.hpp"
#include "tests/random_numbers.hpp"
#include "tests/tree/tree_data.hpp"
#include "tree/choice.hpp"
#include "tree/folds.hpp"
#include "tree/validation.hpp"

namespace plumb::offline {
namespace {

using namespace tree_data;

constexpr std::array<bool, 3> kAllAxes{true, true, true};
constexpr double kNoise = 1e-4;  // [m], 1 sigma

/// What is there to be learnt: nothing, or something smooth of `size` noise sigmas.
struct Truth {
  double size = 0.0;
  bool heavy_tails = false;

  Samples residual(const Samples& q, Random& random) const {
    Samples out(q.rows(), 3);
    for (int axis = 0; axis < 3; ++axis) {
      out.col(axis) = smooth(q.array() * (1.0 - 0.3 * axis), size * kNoise);
      for (Eigen::Index i = 0; i < q.rows(); ++i) {
        const double wild = heavy_tails ? 1.0 / std::sqrt(0.05 + random.unit()) : 1.0;
        out(i, axis) += kNoise * wild * gauss(random);
      }
    }
    return out;
  }
};

Samples poses(int n, int joints, Random& random) { return uniform(n, joints, -1.5, 1.5, random); }

TreeChoice choose(const Samples& q, const Samples& residual, const TreeSettings& settings = {}) {
  return choose_trees(q, residual, kAllAxes, numbered(static_cast<int>(q.rows())), settings);
}

int total(const TreeChoice& choice) {
  return choice.leaves[0] + choice.leaves[1] + choice.leaves[2];
}

/// What the cycle would add to the model, shape (n, 3).
Samples correction(const TreeChoice& choice, const Samples& q) {
  const TrainedDomain domain(choice.domain);
  Samples out(q.rows(), 3);
  std::vector<double> row(q.cols()), u(q.cols());
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    for (Eigen::Index k = 0; k < q.cols(); ++k) row[k] = q(i, k);
    const double weight = domain.normalise(row, u);
    for (int axis = 0; axis < 3; ++axis)
      out(i, axis) = weight * TreeView(choice.trees[axis], static_cast<int>(q.cols())).evaluate(u);
  }
  return out;
}

/// RMS error on 2000 fresh poses with the trees, over that without.
double fresh_ratio(const TreeChoice& choice, const Truth& truth, int joints, Random& random) {
  if (total(choice) == 0) return 1.0;
  const Samples q = poses(2000, joints, random);
  const Samples residual = truth.residual(q, random);
  return (residual - correction(choice, q)).norm() / residual.norm();
}

struct Tally {
  int runs = 0, with_trees = 0, worse = 0;
  double worst = 0.0, sum = 0.0;

  void add(const TreeChoice& choice, double ratio) {
    ++runs;
    with_trees += total(choice) > 0;
    worse += ratio > 1.01;
    worst = std::max(worst, ratio);
    sum += ratio;
  }
};

/// `runs` data sets of `fewest` to `most` poses, all from one seed; as many times more as
/// PLUMB_TEST_SCALE says.
struct Plan {
  Truth truth;
  int joints, fewest, most, runs;
  std::uint64_t seed;
};

Tally run_many(const Plan& plan) {
  const auto& [truth, joints, fewest, most, at_scale_1, seed] = plan;
  const int runs = static_cast<int>(tests::scaled(at_scale_1));
  Tally out;
  for (int run = 0; run < runs; ++run) {
    Random random(seed + run);
    const Samples q = poses(fewest + random.below(most - fewest + 1), joints, random);
    const TreeChoice choice = choose(q, truth.residual(q, random));
    out.add(choice, fresh_ratio(choice, truth, joints, random));
  }
  std::cout << runs << " runs, seed " << seed << ", " << joints << " joints, " << fewest << " to "
            << most << " poses, effect " << truth.size << " sigma: " << out.with_trees
            << " with trees, " << out.worse << " worse by 1 %, worst " << out.worst << ", mean "
            << out.sum / runs << '\n';
  return out;
}

/// One by chance, and one in a hundred.
int allowed(const Tally& tally) { return 1 + tally.runs / 100; }

TEST(TreeChoice, PureNoiseGrowsNoTree) {
  for (const Plan& plan :
       {Plan{{}, 6, 150, 1500, 30, 1000}, Plan{{.heavy_tails = true}, 6, 150, 1500, 15, 2000},
        Plan{{}, 6, 70, 150, 100, 3000}, Plan{{}, 2, 30, 300, 100, 4000}}) {
    const Tally found = run_many(plan);
    EXPECT_LE(found.with_trees, allowed(found));
  }
}

TEST(TreeChoice, AWeakEffectNeverMakesFreshPosesWorse) {
  for (double size : {0.2, 0.3, 0.5})
    for (const Plan& plan :
         {Plan{{.size = size}, 6, 70, 300, 30, 5000}, Plan{{.size = size}, 2, 30, 200, 70, 6000}}) {
      const Tally found = run_many(plan);
      EXPECT_LE(found.worse, allowed(found));
    }
}

TEST(TreeChoice, AClearNonlinearEffectIsLearnt) {
  Random random(7);
  const Truth truth{.size = 10.0};
  const Samples q = poses(2000, 3, random);
  const TreeChoice choice = choose(q, truth.residual(q, random));
  const double ratio = fresh_ratio(choice, truth, 3, random);
  std::cout << choice.reason << " Fresh poses: " << ratio << " of the error.\n";
  EXPECT_LT(ratio, 0.3);
  EXPECT_NEAR(choice.cv_after_m / choice.cv_before_m, ratio, 0.15 * ratio);
  EXPECT_GT(choice.cv_before_m - choice.cv_after_m, choice.gain_se_m);
}

TEST(TreeChoice, SmoothErrorsAreBlendedAndStepsAreNot) {
  Random random(21);
  const Samples q = poses(800, 2, random);
  EXPECT_FALSE(choose(q, Truth{.size = 5.0}.residual(q, random)).trees[0].blend_half_width.empty());
  Samples steps = Truth{}.residual(q, random);
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    steps(i, 0) += q(i, 0) > 0.37 ? 20.0 * kNoise : q(i, 1) > -0.61 ? -20.0 * kNoise : 0.0;
  const TreeChoice choice = choose(q, steps);
  EXPECT_TRUE(choice.trees[0].blend_half_width.empty()) << choice.reason;
  EXPECT_GT(choice.leaves[0], 2);
}

TEST(TreeChoice, OnlyTheAxisThatHasAnEffectGetsATree) {
  Random random(8);
  const Samples q = poses(1000, 4, random);
  Samples residual = Truth{}.residual(q, random);
  residual.col(1) += smooth(q, 1e-3);
  const TreeChoice choice = choose(q, residual);
  EXPECT_EQ(choice.leaves[0], 0);
  EXPECT_GT(choice.leaves[1], 3);
  EXPECT_EQ(choice.leaves[2], 0);
  EXPECT_TRUE(choice.trees[0].bounds.empty());
  EXPECT_EQ(static_cast<int>(choice.trees[1].bounds.size()), 2 * choice.leaves[1]);
}

TEST(TreeChoice, AnAxisThatWasNotMeasuredGetsNoTree) {
  Random random(9);
  const Samples q = poses(1000, 2, random);
  const Samples residual = Truth{.size = 10.0}.residual(q, random);
  const TreeChoice choice =
      choose_trees(q, residual, {true, true, false}, numbered(1000), TreeSettings{});
  EXPECT_GT(choice.leaves[0], 0);
  EXPECT_EQ(choice.leaves[2], 0);
}

TEST(TreeChoice, FewPosesAreRefusedWithTheReason) {
  Random random(10);
  const Samples q = poses(45, 6, random);
  const TreeChoice choice = choose(q, Truth{.size = 10.0}.residual(q, random));
  EXPECT_EQ(total(choice), 0);
  EXPECT_EQ(choice.reason,
            "45 poses cannot carry a local linear model of 6 moving joints: its 7 coefficients an "
            "axis need at least 70 poses.");
}

TEST(TreeChoice, RepeatsOfAPoseAreNotMorePoses) {
  Random random(11);
  const Samples few = poses(45, 6, random);
  Samples q(180, 6);
  std::vector<int> group(180);
  for (int i = 0; i < 180; ++i) {
    q.row(i) = few.row(i % 45);
    group[i] = i % 45;
  }
  const Samples residual = Truth{.size = 10.0}.residual(q, random);
  EXPECT_EQ(total(choose_trees(q, residual, kAllAxes, group, {})), 0);
}

TEST(TreeChoice, RepeatsOfAPoseShareAFold) {
  Random random(12);
  const Samples q = poses(300, 3, random);
  std::vector<int> group(300);
  for (int i = 0; i < 300; ++i) group[i] = 1000 - i % 60;
  const auto fold = deal_folds(q, q, group, 5, 1);
  std::vector<int> size(5);
  for (int i = 0; i < 300; ++i) {
    EXPECT_EQ(fold[i], fold[i % 60]);
    ++size[fold[i]];
  }
  for (int n : size) EXPECT_EQ(n, 60);
}

TEST(TreeChoice, TheOrderOfTheRowsAndTheNamesOfTheGroupsDoNotMatter) {
  Random random(13);
  const Samples q = poses(600, 3, random);
  const Samples residual = Truth{.size = 5.0}.residual(q, random);
  const TreeChoice first = choose(q, residual);
  ASSERT_GT(total(first), 0);
  for (int run = 0; run < 3; ++run) {
    const auto order = shuffled(600, random);
    const TreeChoice other =
        choose_trees(permuted(q, order), permuted(residual, order), kAllAxes, order, {});
    EXPECT_EQ(first.trees, other.trees);
    EXPECT_NEAR(first.cv_after_m, other.cv_after_m, 1e-12 * first.cv_after_m);
  }
}

TEST(TreeChoice, AJointThatStandsStillGetsAHairsWidthAndNoCoefficient) {
  Random random(14);
  Samples q = poses(600, 4, random);
  q.col(2).setConstant(0.7);
  const TreeChoice choice = choose(q, Truth{.size = 5.0}.residual(q, random));
  EXPECT_LT(choice.domain.q_min[2], 0.7);
  EXPECT_GT(choice.domain.q_max[2], 0.7);
  for (const auto& tree : choice.trees) {
    ASSERT_GT(tree.bounds.size(), 0u);
    for (std::size_t i = 3; i < tree.coefficients.size(); i += 5)
      EXPECT_EQ(tree.coefficients[i], 0.0);
  }
}

TEST(TreeChoice, TheCrossValidatedErrorIsThatOfTheRuntimeOnEachFold) {
  Random random(15);
  const Samples q = poses(400, 3, random);
  const Samples residual = Truth{.size = 5.0}.residual(q, random);
  const auto fold = deal_folds(q, residual, numbered(400), 4, 1);
  const Validation validation = validate_crisp({q, residual, kAllAxes, fold, 4}, {});
  for (int f = 0; f < 4; ++f) {
    std::vector<int> inside, held;
    for (int i = 0; i < 400; ++i) (fold[i] == f ? held : inside).push_back(i);
    Samples trained(inside.size(), 3), seen(inside.size(), 3);
    for (std::size_t i = 0; i < inside.size(); ++i) {
      trained.row(i) = q.row(inside[i]);
      seen.row(i) = residual.row(inside[i]);
    }
    TreeChoice model;
    for (int k = 0; k < 3; ++k) {
      model.domain.q_min.push_back(trained.col(k).minCoeff());
      model.domain.q_max.push_back(trained.col(k).maxCoeff());
    }
    Samples u(trained.rows(), 3);
    const TrainedDomain domain(model.domain);
    for (Eigen::Index i = 0; i < u.rows(); ++i) {
      std::array<double, 3> row{trained(i, 0), trained(i, 1), trained(i, 2)}, to{};
      domain.normalise(row, to);
      u.row(i) << to[0], to[1], to[2];
    }
    for (int axis = 0; axis < 3; ++axis) {
      const GrownTree tree = grow(u, seen.col(axis), {});
      for (int size : {0, 1, 2, 5, int(validation.squared_error[axis].cols()) - 1}) {
        model.trees[axis] = tree.cut(size);
        Samples q_held(held.size(), 3);
        for (std::size_t i = 0; i < held.size(); ++i) q_held.row(i) = q.row(held[i]);
        const Samples predicted = correction(model, q_held);
        double sum = 0.0;
        for (std::size_t i = 0; i < held.size(); ++i)
          sum += std::pow(residual(held[i], axis) - predicted(i, axis), 2);
        EXPECT_NEAR(validation.squared_error[axis](f, size) / sum, 1.0, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace plumb::offline
