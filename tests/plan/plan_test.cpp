// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "fit/fit_judgement.hpp"
#include "plan/planning.hpp"
#include "simulate/simulate.hpp"
#include "solve/evaluation.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr double kNoise_m = 20e-6;

Cell some_cell(std::uint64_t seed) {
  Cell cell = random_cell(seed, 6, format::Convention::kModified, ArmKind::kRevolute);
  cell.measurement.sigma_m = kNoise_m;
  return cell;
}

SimulationPlan some_plan(std::uint64_t seed) {
  SimulationPlan plan;
  plan.noise_m = kNoise_m;
  plan.seed = seed;
  plan.truth.geometry_m = 0.2e-3;
  plan.truth.geometry_rad = 0.2e-3;
  return plan;
}

std::vector<int> all_rows(const Measurements& m) {
  std::vector<int> out(static_cast<std::size_t>(m.size()));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

RowsN joints_of(const PosePlan& plan) {
  RowsN out(static_cast<Eigen::Index>(plan.poses.size()), plan.poses[0].q.size());
  for (std::size_t i = 0; i < plan.poses.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = plan.poses[i].q.transpose();
  return out;
}

TEST(Plan, ThePromisedErrorIsThatOfArmsMeasuredAtThesePosesAndCalibrated) {
  const int count = static_cast<int>(tests::scaled(30));
  std::printf("[ seeds    ] 1 .. %d\n", count);
  double promised = 0.0, found = 0.0, random_poses = 0.0;
  for (int seed = 1; seed <= count; ++seed) {
    const auto s = static_cast<std::uint64_t>(seed);
    const Cell cell = some_cell(s);
    const PosePlan plan =
        plan_poses(cell, nothing_measured(cell), {.n = 40, .rules = {.pool = 300, .seed = s}});
    SimulationPlan recipe = some_plan(s);
    recipe.truth.seed = s;
    SimulationPlan fresh = recipe;
    fresh.poses = 300;
    fresh.seed = s + 1000;
    const Simulation truth = simulate(cell, fresh);
    const auto true_error = [&](const RowsN& q) {
      SimulationPlan at = recipe;
      at.q = q;
      at.poses = static_cast<int>(q.rows());
      const Simulation measured = simulate(cell, at);
      const Calibration c = calibrate(cell, measured.measured, all_rows(measured.measured));
      return std::sqrt((truth.true_p_M - predict_points(c.state, truth.measured)).squaredNorm() /
                       300.0);
    };
    promised += std::pow(plan.after.mean, 2) / count;
    found += std::pow(true_error(joints_of(plan)), 2) / count;
    RowsN q(40, 6);
    tests::Random random(s);
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 6; ++j) {
        const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
        q(i, j) = random.uniform(row.q_min, row.q_max);
      }
    random_poses += std::pow(true_error(q), 2) / count;
  }
  std::printf("[ error    ] promised %.1f um, found %.1f um, at random poses %.1f um\n",
              std::sqrt(promised) * 1e6, std::sqrt(found) * 1e6, std::sqrt(random_poses) * 1e6);
  EXPECT_NEAR(std::sqrt(found / promised), 1.05, 0.15);  // RMS over poses and seeds, not the mean
  EXPECT_LT(found, 0.9 * random_poses);
}

TEST(Plan, ThePredictedCovarianceIsThatOfTheFit) {
  const int count = static_cast<int>(tests::scaled(10));
  std::printf("[ seeds    ] 1 .. %d\n", count);
  for (int seed = 1; seed <= count; ++seed) {
    const auto s = static_cast<std::uint64_t>(seed);
    const Cell cell = some_cell(s);
    const PosePlan plan =
        plan_poses(cell, nothing_measured(cell), {.n = 60, .rules = {.pool = 300, .seed = s}});
    SimulationPlan recipe = some_plan(s);
    recipe.q = joints_of(plan);
    recipe.poses = 60;
    const Simulation measured = simulate(cell, recipe);
    const Calibration c = calibrate(cell, measured.measured, all_rows(measured.measured));
    // The fit reckons with the noise it saw, if that is more than what was stated.
    const Rows3 left = residuals(measured.measured, predict_points(c.state, measured.measured));
    const double dof = 3.0 * 60.0 - static_cast<double>(c.estimates.size());
    const double scale = std::max(1.0, left.squaredNorm() / dof / (kNoise_m * kNoise_m));
    // Through the parameters that the fit kept, at poses of another seed.
    SimulationPlan other = some_plan(s + 500);
    other.poses = 200;
    const Simulation at = simulate(cell, other);
    FitData data;
    data.measured = &at.measured;
    data.rows = all_rows(at.measured);
    data.sigma_m = Rows3::Ones(at.measured.size(), 3);
    const Eigen::MatrixXd J = evaluate(data, c.state, c.parameters).jacobian;
    double mean = 0.0;
    for (int i = 0; i < at.measured.size(); ++i) {
      const Eigen::MatrixXd A = J.middleRows(3 * i, 3);
      mean += std::sqrt((A * c.covariance * A.transpose()).trace() / scale) / at.measured.size();
    }
    EXPECT_NEAR(plan.after.mean / mean, 1.0, 0.03) << seed;
  }
}

TEST(Plan, MeasuredPosesCountAndTheWorstPredictionNeverRises) {
  const Cell cell = some_cell(3);
  SimulationPlan recipe = some_plan(3);
  recipe.poses = 50;
  const Simulation measured = simulate(cell, recipe);
  const PlanRequest request{.n = 20, .rules = {.pool = 300}};
  const PosePlan plan = plan_poses(cell, measured.measured, request);
  EXPECT_EQ(plan.measured, measured.measured.size());
  EXPECT_LT(plan.after.worst, plan.before.worst);
  EXPECT_LT(plan.after.mean, plan.before.mean);
  const PosePlan again = plan_poses(cell, measured.measured, request);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(plan.poses[i].q, again.poses[i].q);
}

TEST(Plan, KeepsToLimitsAndBoxesAndSaysWhenThereIsNoPose) {
  const Cell cell = some_cell(4);
  ArmState nominal;
  nominal.arm.calibrated = cell.nominal;
  nominal.X_TG.p = {0.05, 0.0, 0.1};
  PlanRequest request{
      .n = 15,
      .rules = {.boxes = {{{-5.0, -5.0, 0.3}, {5.0, 0.0, 5.0}}}, .joint_share = 0.6, .pool = 200}};
  const PosePlan plan = plan_poses(cell, nothing_measured(cell), request);
  for (const auto& pose : plan.poses) {
    for (int j = 0; j < 6; ++j) {
      const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
      const double middle = 0.5 * (row.q_min + row.q_max);
      EXPECT_LE(std::abs(pose.q(j) - middle), 0.3 * (row.q_max - row.q_min) + 1e-12);
    }
    const Rows3 p = predict_points(nominal, RowsN(pose.q.transpose()));
    EXPECT_LE(p(0, 1), 0.0);
    EXPECT_GE(p(0, 2), 0.3);
  }
  request.rules.boxes = {{{50.0, 50.0, 50.0}, {51.0, 51.0, 51.0}}};
  EXPECT_THROW(plan_poses(cell, nothing_measured(cell), request), Failure);
}

}  // namespace
}  // namespace plumb::offline
