// SPDX-License-Identifier: Apache-2.0
// A Jacobian too large to be kept: what is solved from sums over the rows is what all rows say.
#include "solve/many_rows.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <Eigen/QR>
#include <algorithm>
#include <numeric>
#include <set>

#include "fit/calibrate.hpp"
#include "noise/weights.hpp"
#include "simulate/simulate.hpp"
#include "solve/evaluation.hpp"
#include "solve/outliers.hpp"
#include "solve/solver.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

constexpr double kNoise_m = 20e-6;
constexpr int kPoses = 24000;

struct Case {
  Cell cell;
  Measurements measured;
  std::vector<int> rows;
};

Case arm_measured(int poses) {
  Case out;
  out.cell = random_cell(7, 6, format::Convention::kStandard, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = poses;
  plan.noise_m = kNoise_m;
  plan.seed = 7;
  plan.truth.geometry_m = 0.5e-3;
  plan.truth.geometry_rad = 0.5e-3;
  plan.truth.seed = 7;
  out.measured = simulate(out.cell, plan).measured;
  out.rows.resize(static_cast<std::size_t>(poses));
  std::iota(out.rows.begin(), out.rows.end(), 0);
  return out;
}

FitData data_of(const Case& c) {
  FitData out;
  out.cell = &c.cell;
  out.measured = &c.measured;
  out.rows = c.rows;
  out.sigma_m = stated_sigma(c.cell, c.measured);
  return out;
}

/// Runs on one processor only while it lives.
class OneProcessor {
 public:
  OneProcessor() {
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE; ++i)
      if (CPU_ISSET(i, &before_)) {
        CPU_SET(i, &one);
        break;
      }
    sched_setaffinity(0, sizeof one, &one);
  }
  OneProcessor(const OneProcessor&) = delete;
  OneProcessor& operator=(const OneProcessor&) = delete;
  ~OneProcessor() { sched_setaffinity(0, sizeof before_, &before_); }

 private:
  cpu_set_t before_;
};

/// All rows solved from where a few of them lead.
struct Solved {
  FitData data;
  std::vector<Parameter> parameters;
  Solution all;
};

Solved solved(const Case& c) {
  const Case some{c.cell, c.measured, {c.rows.begin(), c.rows.begin() + 1000}};
  const Calibration near = calibrate(some.cell, some.measured, some.rows);
  Solved out{.data = data_of(c), .parameters = near.parameters, .all = {}};
  out.all = solve(out.data, near.state, near.parameters);
  return out;
}

TEST(ManyRows, TheFitFromSumsIsTheFitOfAllRows) {
  const Case c = arm_measured(kPoses);
  const Solved s = solved(c);
  ASSERT_TRUE(is_many(s.data, s.parameters));
  ASSERT_TRUE(s.all.converged);
  const Solution whole = evaluate(s.data, s.all.state, s.parameters);
  ASSERT_EQ(whole.residual.size(), s.all.residual.size());
  EXPECT_LT((whole.residual - s.all.residual).cwiseAbs().maxCoeff(), 1e-9);
  // What all rows would still change is far below what they leave open.
  const Eigen::MatrixXd& J = whole.jacobian;
  const Eigen::VectorXd length = J.colwise().norm();
  const Eigen::MatrixXd unit = J * length.cwiseInverse().asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(unit);
  const Eigen::VectorXd seen =
      (qr.householderQ().transpose() * whole.residual).head(J.cols());  // in standard deviations
  EXPECT_LT(seen.norm(), 0.01);
  const Eigen::MatrixXd information = J.transpose() * J;
  const Eigen::MatrixXd of_sums = s.all.jacobian.transpose() * s.all.jacobian;
  for (Eigen::Index i = 0; i < J.cols(); ++i)
    for (Eigen::Index k = 0; k < J.cols(); ++k)
      EXPECT_NEAR(of_sums(i, k), information(i, k), 1e-8 * length(i) * length(k));
  const Eigen::VectorXd distances = deletion_distances(s.data, s.all, s.parameters);
  EXPECT_LT((distances - deletion_distances(s.data, whole)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ManyRows, TheResultDoesNotDependOnTheNumberOfThreads) {
  const Case c = arm_measured(kPoses);
  const Solved both = solved(c);
  const OneProcessor one;
  const Solved alone = solved(c);
  EXPECT_EQ(both.all.iterations, alone.all.iterations);
  EXPECT_TRUE(both.all.residual == alone.all.residual);
  EXPECT_TRUE(both.all.jacobian == alone.all.jacobian);
}

TEST(ManyRows, OutliersAmongThemAreFoundAndNotFitted) {
  Case c = arm_measured(kPoses);
  std::set<int> spoilt;
  for (int i = 17; i < kPoses; i += 500) {
    c.measured.p_M(i, i % 3) += 1e-3;
    spoilt.insert(i);
  }
  const Calibration found = calibrate(c.cell, c.measured, c.rows);
  std::set<int> taken;
  for (const auto& outlier : found.outliers) taken.insert(outlier.row);
  EXPECT_EQ(taken, spoilt);
  EXPECT_NEAR(found.sigma0, 1.0, 0.02);
}

TEST(ManyRows, WhatOutliersAreLeftOutOfIsTheFitOfTheOtherRows) {
  const Case clean = arm_measured(kPoses);
  const Solved right = solved(clean);
  for (const double error_m : {0.4e-3, 3e-3, 0.5}) {
    Case c = clean;
    std::vector<int> left;
    for (int i = 0; i < kPoses; ++i) {
      if (i % 500 == 17)
        c.measured.p_M(i, i % 3) += i % 1000 == 17 ? error_m : 0.6 * error_m;
      else
        left.push_back(i);
    }
    FitData data = data_of(c);
    Solution found;
    found.state = right.all.state;
    solve_without_outliers(data, right.parameters, found);
    EXPECT_EQ(data.rows, left) << error_m;
    EXPECT_TRUE(found.converged);
    const Solution others = solve(data, right.all.state, right.parameters);
    EXPECT_LT((found.residual - others.residual).cwiseAbs().maxCoeff(), 1e-3) << error_m;
  }
}

}  // namespace
}  // namespace plumb::offline
