// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "simulate/simulate.hpp"
#include "solve/evaluation.hpp"
#include "solve/outliers.hpp"
#include "solve/solver.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

using tests::Random;
using tests::scaled;

constexpr double kNoise_m = 20e-6;

std::vector<int> all_rows(const Measurements& m) {
  std::vector<int> rows(m.size());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// One of: 4 to 7 joints, both conventions, SCARA.
Cell some_arm(std::uint64_t seed) {
  Random dice(seed);
  const auto convention =
      dice.below(2) == 0 ? format::Convention::kStandard : format::Convention::kModified;
  const int kind = dice.below(5);
  return kind == 4 ? random_cell(seed, 4, convention, ArmKind::kScara)
                   : random_cell(seed, 4 + kind, convention, ArmKind::kRevolute);
}

/// Anywhere within 5 m, turned by anything up to half a turn.
format::Pose far_frame(std::uint64_t seed) {
  Random dice(seed ^ 0x5eed);
  Vector3 axis(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1));
  axis = axis.normalized() * dice.uniform(0, M_PI);
  format::Twist twist;
  for (int k = 0; k < 3; ++k) twist.e[k] = axis(k);
  Transformd X = exp(twist);
  X.p = Vector3(dice.uniform(-5, 5), dice.uniform(-5, 5), dice.uniform(-5, 5));
  return to_pose(X);
}

SimulationPlan plan_of(std::uint64_t seed, int poses, double noise_m) {
  SimulationPlan plan;
  plan.poses = poses;
  plan.noise_m = noise_m;
  plan.seed = seed;
  plan.truth.geometry_m = 0.5e-3;
  plan.truth.geometry_rad = 0.5e-3;
  plan.truth.seed = seed;
  plan.truth.X_MB = far_frame(seed);
  return plan;
}

/// Every fiftieth pose is off by `sigmas` standard deviations in a random direction.
std::set<int> spoil(Measurements& m, double sigmas, std::uint64_t seed) {
  Random dice(seed ^ 0xbad);
  std::set<int> spoilt;
  while (static_cast<int>(spoilt.size()) < std::max(1, m.size() / 50))
    spoilt.insert(dice.below(m.size()));
  for (int i : spoilt) {
    Vector3 way(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1));
    m.p_M.row(i) += sigmas * kNoise_m * way.normalized().transpose();
  }
  return spoilt;
}

ArmState truth_of(const Simulation& s) {
  ArmState out;
  out.arm.calibrated = s.true_chain;
  out.X_MB = s.X_MB;
  out.X_TG = s.X_TG;
  return out;
}

double largest_difference(const ArmState& a, const ArmState& b, const RowsN& q) {
  return (predict_points(a, q) - predict_points(b, q)).rowwise().norm().maxCoeff();
}

TEST(RobustFit, FindsTheSameMinimumAsFromTheTruthWhereverTheTrackerStandsAndWhateverIsSpoilt) {
  const long cells = scaled(200);
  int same = 0, silent_and_wrong = 0;
  for (long seed = 1; seed <= cells; ++seed) {
    Cell cell = some_arm(seed);
    cell.measurement.sigma_m = kNoise_m;
    Simulation s = simulate(cell, plan_of(seed, 150, kNoise_m));
    const double sigmas = Random(seed).below(2) == 0 ? 20.0 : 20000.0;  // 0.4 mm or 0.4 m
    spoil(s.measured, sigmas, seed);
    const auto rows = all_rows(s.measured);
    const ArmState reference = calibrate_from(cell, s.measured, rows, truth_of(s)).state;
    const Calibration c = calibrate(cell, s.measured, rows);
    const bool is_same = largest_difference(reference, c.state, s.measured.q) < 1e-6;
    same += is_same;
    silent_and_wrong += !is_same && c.remarks.empty();
  }
  std::printf("%ld cells: same minimum in %d, silently another in %d\n", cells, same,
              silent_and_wrong);
  EXPECT_GE(same, 0.99 * static_cast<double>(cells));
  EXPECT_EQ(silent_and_wrong, 0);
}

TEST(RobustFit, ListsTheSpoiltPosesAndHardlyAnyOther) {
  const long cells = scaled(60);
  int spoilt_poses = 0, found = 0, others = 0, clean_listed = 0;
  for (long seed = 1; seed <= cells; ++seed) {
    Cell cell = some_arm(seed);
    cell.measurement.sigma_m = kNoise_m;
    Simulation s = simulate(cell, plan_of(seed, 150, kNoise_m));
    clean_listed +=
        static_cast<int>(calibrate(cell, s.measured, all_rows(s.measured)).outliers.size());
    const auto spoilt = spoil(s.measured, 20.0, seed);
    spoilt_poses += static_cast<int>(spoilt.size());
    for (const auto& o : calibrate(cell, s.measured, all_rows(s.measured)).outliers) {
      if (spoilt.contains(o.row)) {
        ++found;
        EXPECT_NEAR(o.error_m, 20.0 * kNoise_m, 5.0 * kNoise_m);
      } else {
        ++others;
      }
    }
  }
  std::printf("%ld cells: %d of %d spoilt poses listed, %d others; %d in clean data\n", cells,
              found, spoilt_poses, others, clean_listed);
  EXPECT_GE(found, 0.99 * spoilt_poses);
  EXPECT_LE(others, 0.01 * spoilt_poses);
  EXPECT_EQ(clean_listed, 0);
}

TEST(RobustFit, DeletionDistancesAreThoseOfFitsWithoutThePose) {
  Cell cell = random_cell(7, 5, format::Convention::kStandard, ArmKind::kRevolute);
  const Simulation s = simulate(cell, plan_of(7, 40, kNoise_m));
  const Calibration c = calibrate(cell, s.measured, all_rows(s.measured));
  FitData data;
  data.measured = &s.measured;
  data.rows = all_rows(s.measured);
  data.sigma_m = Rows3::Constant(40, 3, kNoise_m);
  std::vector<Parameter> parameters;
  for (const auto& p : candidate_parameters(cell, Orientation::kIgnored))
    for (const auto& e : c.estimates)
      if (e.name == p.name) parameters.push_back(p);
  const Solution all = solve(data, c.state, parameters);
  const Eigen::VectorXd distance = deletion_distances(data, all);
  for (int left_out = 0; left_out < 40; left_out += 7) {
    FitData others = data;
    std::erase(others.rows, left_out);
    const Solution without = solve(others, all.state, parameters);
    FitData one = data;
    one.rows = {left_out};
    const Solution there = evaluate(one, without.state, parameters);
    // e^T (I + J (J_o^T J_o)^-1 J^T)^-1 e with the prediction error e of the pose left out.
    const Eigen::MatrixXd information = without.jacobian.transpose() * without.jacobian;
    const Eigen::MatrixXd covariance =
        Eigen::MatrixXd::Identity(3, 3) +
        there.jacobian * information.ldlt().solve(there.jacobian.transpose());
    const double expected = std::sqrt(there.residual.dot(covariance.ldlt().solve(there.residual)));
    EXPECT_NEAR(distance(left_out) / expected, 1.0, 1e-3);
  }
}

TEST(RobustFit, RefusesAnArmOfAnotherConventionInsteadOfBendingIt) {
  int refused = 0, cells = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
    const Simulation s = simulate(cell, plan_of(seed, 100, kNoise_m));
    cell.nominal.convention = format::Convention::kModified;
    ++cells;
    try {
      (void)calibrate(cell, s.measured, all_rows(s.measured));
    } catch (const Failure& f) {
      EXPECT_EQ(f.exit_code(), Exit::kNumbersSayNo);
      ++refused;
    }
  }
  EXPECT_EQ(refused, cells);
}

TEST(Prior, HoldsAParameterTheTighterTheSmallerItsSigma) {
  Cell cell = random_cell(3, 6, format::Convention::kStandard, ArmKind::kRevolute);
  cell.measurement.sigma_m = kNoise_m;
  const Simulation s = simulate(cell, plan_of(3, 100, kNoise_m));
  const auto rows = all_rows(s.measured);
  const auto estimate = [&](double sigma) {
    cell.fit.priors.clear();
    if (sigma > 0.0) cell.fit.priors = {{"J2.theta", sigma}};
    const Calibration calibration = calibrate(cell, s.measured, rows);
    for (const auto& e : calibration.estimates)
      if (e.name == "J2.theta") return e;
    return Estimate{};
  };
  const Estimate free = estimate(0.0);
  const double offset = free.value - free.nominal;
  ASSERT_GT(std::abs(offset), 10.0 * free.std);
  EXPECT_NEAR(estimate(1.0).value, free.value, 1e-3 * free.std);
  // Two equally sure sources meet half way; their quarrel widens the scatter of the poses a little.
  const Estimate half = estimate(free.std);
  EXPECT_NEAR((half.value - half.nominal) / offset, 0.45, 0.05);
  EXPECT_LT(half.std / free.std, 0.9);
  EXPECT_NEAR(estimate(1e-9).value, free.nominal, 1e-8);
}

TEST(Prior, FreesWhatThePosesCannotTellApart) {
  Cell cell = random_cell(1, 6, format::Convention::kStandard, ArmKind::kRevolute);
  const Simulation s = simulate(cell, plan_of(1, 100, kNoise_m));
  const auto rows = all_rows(s.measured);
  const Calibration without = calibrate(cell, s.measured, rows);
  ASSERT_FALSE(without.held.empty());
  const std::string name = without.held.front();
  cell.fit.priors = {{name, 1e-4}};
  const Calibration with = calibrate(cell, s.measured, rows);
  const auto found = std::find_if(with.estimates.begin(), with.estimates.end(),
                                  [&](const Estimate& e) { return e.name == name; });
  ASSERT_NE(found, with.estimates.end());
  EXPECT_LE(found->std, 1.2e-4);
}

/// The leaning column of a warm SCARA shows how high the reflector is, ten thousand times too
/// weakly.
TEST(RobustFit, AnEffectDoesNotCarryTheReflectorAway) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Cell cell = random_cell(seed, 4, format::Convention::kModified, ArmKind::kScara);
    cell.measurement.sigma_m = kNoise_m;
    SimulationPlan plan = plan_of(seed, 200, kNoise_m);
    plan.truth.sized.push_back(
        {.name = "thermal_growth", .size = {}, .size_sigma = 5.0, .joints = {}, .numbers = {}});
    const Simulation s = simulate(cell, plan);
    ASSERT_FALSE(s.measured.context.sensors.empty());
    const Calibration without = calibrate(cell, s.measured, all_rows(s.measured));
    cell.effects.push_back(
        {.name = "thermal_growth",
         .joints = {},
         .options = {{"sensor", std::string(s.measured.context.sensors.front())}},
         .place = {}});
    const Calibration with = calibrate(cell, s.measured, all_rows(s.measured));
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(with.state.X_TG.p[k], without.state.X_TG.p[k], 2e-3) << "seed " << seed;
  }
}

}  // namespace
}  // namespace plumb::offline
