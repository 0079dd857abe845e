// SPDX-License-Identifier: Apache-2.0
#include "plan/d_optimal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "plan/design_space.hpp"
#include "plan/pose_pool.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

Eigen::MatrixXd random_matrix(tests::Random& random, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd out(rows, columns);
  for (double& v : out.reshaped()) v = random.uniform(-1.0, 1.0);
  return out;
}

double ln_det(const Eigen::MatrixXd& M) {
  return 2.0 * M.llt().matrixL().toDenseMatrix().diagonal().array().log().sum();
}

struct Pool {
  std::vector<Eigen::MatrixXd> candidates;
  Eigen::MatrixXd known;
  Eigen::VectorXd prior;

  /// ln det of the whole information, added up anew.
  double ln_det_of(const std::vector<int>& chosen) const {
    Eigen::MatrixXd M = prior.asDiagonal();
    M += known.transpose() * known;
    for (const int i : chosen) M += candidates[i].transpose() * candidates[i];
    return ln_det(M);
  }
};

Pool tiny_pool(tests::Random& random, int count, Eigen::Index parameters) {
  Pool out;
  for (int i = 0; i < count; ++i) out.candidates.push_back(random_matrix(random, 2, parameters));
  out.known = random_matrix(random, 1, parameters);
  out.prior = Eigen::VectorXd::Constant(parameters, 1e-3);
  return out;
}

TEST(Information, FollowsTheDeterminantAndTheInverseThroughAddingAndRemoving) {
  const int count = static_cast<int>(tests::scaled(200));
  std::printf("[ count    ] %d, seed 1\n", count);
  tests::Random random(1);
  for (int k = 0; k < count; ++k) {
    Eigen::MatrixXd M = Eigen::VectorXd::Constant(6, 0.5).asDiagonal();
    Information information(Eigen::VectorXd::Constant(6, 0.5));
    std::vector<Eigen::MatrixXd> rows;
    for (const int n : {2, 9, 3, 1}) {
      const Eigen::MatrixXd A = random_matrix(random, n, 6);
      const Eigen::MatrixXd grown = M + A.transpose() * A;
      EXPECT_NEAR(information.gain(A), ln_det(grown) - ln_det(M), 1e-9);
      information.add(A);
      rows.push_back(A);
      M = grown;
    }
    information.remove(rows[2]);
    M -= rows[2].transpose() * rows[2];
    EXPECT_NEAR(information.ln_det(), ln_det(M), 1e-8);
    EXPECT_LT((information.covariance() * M - Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-8);
  }
}

TEST(DOptimal, IsTheBestOfAllSubsetsOfTinyPoolsInNinetyOfAHundredAndNeverFarFromIt) {
  const int count = static_cast<int>(tests::scaled(100));
  std::printf("[ count    ] %d, seed 2\n", count);
  tests::Random random(2);
  int exact = 0;
  double worst = 0.0;
  for (int k = 0; k < count; ++k) {
    const Pool pool = tiny_pool(random, 12, 5);
    double best = -1e300;
    for (int mask = 0; mask < 4096; ++mask) {
      std::vector<int> subset;
      for (int i = 0; i < 12; ++i)
        if ((mask >> i & 1) != 0) subset.push_back(i);
      if (subset.size() == 4) best = std::max(best, pool.ln_det_of(subset));
    }
    const Design design =
        d_optimal(pool.candidates, pool.known, pool.prior, 4, DesignCriterion::all(5));
    const double found = pool.ln_det_of(design.chosen);
    EXPECT_NEAR(design.value, found - pool.ln_det_of({}), 1e-8);
    exact += found > best - 1e-9 ? 1 : 0;
    worst = std::max(worst, best - found);
  }
  std::printf("[ exact    ] %d of %d, worst short by %.3f of ln det\n", exact, count, worst);
  EXPECT_GE(exact, 0.9 * count);
  EXPECT_LT(worst, 0.5);
}

TEST(DOptimal, WeighsGroupsSoThatOneEffectIsToldFromTheRest) {
  const int count = static_cast<int>(tests::scaled(100));
  std::printf("[ count    ] %d, seed 3\n", count);
  tests::Random random(3);
  int exact = 0;
  for (int k = 0; k < count; ++k) {
    const Pool pool = tiny_pool(random, 10, 4);
    // Parameter 3 beyond 0, 1, 2: ln of its information once they are free.
    const DesignCriterion criterion{{{{0, 1, 2, 3}, 1.0}, {{0, 1, 2}, -1.0}}};
    const auto schur = [&](const std::vector<int>& chosen) {
      Eigen::MatrixXd M = pool.prior.asDiagonal();
      M += pool.known.transpose() * pool.known;
      for (const int i : chosen) M += pool.candidates[i].transpose() * pool.candidates[i];
      return -std::log(M.inverse()(3, 3));
    };
    double best = -1e300;
    for (int a = 0; a < 10; ++a)
      for (int b = a + 1; b < 10; ++b)
        for (int c = b + 1; c < 10; ++c) best = std::max(best, schur({a, b, c}));
    const Design design = d_optimal(pool.candidates, pool.known, pool.prior, 3, criterion);
    EXPECT_NEAR(design.value, schur(design.chosen) - schur({}), 1e-7);
    exact += schur(design.chosen) > best - 1e-9 ? 1 : 0;
  }
  std::printf("[ exact    ] %d of %d\n", exact, count);
  EXPECT_GE(exact, 0.8 * count);
}

TEST(DOptimal, PosesOfAnArmBeatEveryRandomSetInAHundredOfAHundredSeeds) {
  const int count = static_cast<int>(tests::scaled(100));
  std::printf("[ seeds    ] 1 .. %d, 20 random sets each\n", count);
  for (int seed = 1; seed <= count; ++seed) {
    const auto s = static_cast<std::uint64_t>(seed);
    const Cell cell = random_cell(s, 6, format::Convention::kModified, ArmKind::kRevolute);
    ArmState state;
    state.arm.calibrated = cell.nominal;
    state.X_TG.p = {0.05, 0.0, 0.1};
    const Measurements nothing = nothing_measured(cell);
    const Measurements at =
        imagined(cell, nothing, pose_pool(cell, state, {.pool = 120, .seed = s}), s);
    const DesignSpace space = design_space(cell, state, at, 1e-5, 0.0);
    const Eigen::MatrixXd lines = space.lines(at);
    Pool pool{{}, Eigen::MatrixXd(0, space.size()), space.prior()};
    for (int i = 0; i < at.size(); ++i) pool.candidates.emplace_back(lines.middleRows(3 * i, 3));
    const Design design =
        d_optimal(pool.candidates, pool.known, pool.prior, 14, DesignCriterion::all(space.size()));
    const double found = pool.ln_det_of(design.chosen);
    EXPECT_EQ(design.chosen.size(), 14U);
    EXPECT_EQ(std::adjacent_find(design.chosen.begin(), design.chosen.end()), design.chosen.end());
    tests::Random random(s);
    std::vector<int> order(static_cast<std::size_t>(at.size()));
    std::iota(order.begin(), order.end(), 0);
    for (int k = 0; k < 20; ++k) {
      for (std::size_t i = 0; i < 14; ++i)
        std::swap(
            order[i],
            order[i + static_cast<std::size_t>(random.below(static_cast<int>(order.size() - i)))]);
      EXPECT_GT(found, pool.ln_det_of({order.begin(), order.begin() + 14})) << seed;
    }
  }
}

TEST(DOptimal, TakesThePoolWholeIfMoreIsAskedForAndNothingFromNothing) {
  tests::Random random(5);
  const Pool pool = tiny_pool(random, 3, 4);
  EXPECT_EQ(d_optimal(pool.candidates, pool.known, pool.prior, 9, DesignCriterion::all(4)).chosen,
            (std::vector<int>{0, 1, 2}));
  EXPECT_TRUE(d_optimal({}, pool.known, pool.prior, 9, DesignCriterion::all(4)).chosen.empty());
}

}  // namespace
}  // namespace plumb::offline
