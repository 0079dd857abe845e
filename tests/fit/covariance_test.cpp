// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "arm/arm_change.hpp"
#include "fit/calibrate.hpp"
#include "simulate/simulate.hpp"
#include "solve/evaluation.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

using tests::scaled;

constexpr double kNoise_m = 20e-6;

struct Case {
  Cell cell;
  Simulation simulation;
};

/// 4 to 7 joints, both conventions, SCARA.
Case some_case(std::uint64_t seed) {
  tests::Random dice(seed ^ 0xc0c0);
  const auto convention =
      dice.below(2) == 0 ? format::Convention::kStandard : format::Convention::kModified;
  const int kind = dice.below(5);
  Cell cell = kind == 4 ? random_cell(seed, 4, convention, ArmKind::kScara)
                        : random_cell(seed, 4 + kind, convention, ArmKind::kRevolute);
  cell.measurement.sigma_m = kNoise_m;
  SimulationPlan plan;
  plan.poses = 60 + dice.below(140);
  plan.noise_m = kNoise_m;
  plan.seed = seed;
  plan.truth.seed = seed;
  plan.truth.geometry_m = 0.2e-3;
  plan.truth.geometry_rad = 0.2e-3;
  return {cell, simulate(cell, plan)};
}

/// True minus fitted, for every candidate. Frame: the small motion that is still missing.
Eigen::VectorXd missing(const std::vector<Parameter>& parameters, const ArmState& fitted,
                        const Simulation& s) {
  ArmState truth;
  truth.arm.calibrated = s.true_chain;
  truth.X_TG = s.X_TG;
  const Transformd X = from_pose(fitted.X_MB).inverse() * from_pose(s.X_MB);
  const Vector3 turn = rotation_vector(X.R);
  Eigen::VectorXd out(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters[i];
    if (p.kind == Parameter::Kind::kFrame)
      out(i) = p.component < 3 ? X.p(p.component) : turn(p.component - 3);
    else
      out(i) = value_of(truth, p) - value_of(fitted, p);
  }
  return out;
}

struct Verdict {
  double distance2 = 0.0;  // Mahalanobis
  int parameters = 0;
  int inside = 0;  // of the parameters: true value inside its 95 % interval
};

/// The truth seen in the identifiable subspace: what held parameters are wrong by moves the kept
/// ones to where they do the same to the points.
Verdict judge(const Case& one) {
  const auto& [cell, s] = one;
  std::vector<int> rows(s.measured.size());
  std::iota(rows.begin(), rows.end(), 0);
  const Calibration c = calibrate(cell, s.measured, rows);
  const auto candidates = candidate_parameters(cell, Orientation::kIgnored);
  std::vector<Parameter> kept, held;
  for (const auto& p : candidates) {
    const bool fitted = std::any_of(c.estimates.begin(), c.estimates.end(),
                                    [&](const Estimate& e) { return e.name == p.name; });
    (fitted ? kept : held).push_back(p);
  }
  FitData data;
  data.measured = &s.measured;
  data.rows = rows;
  data.sigma_m = Rows3::Constant(s.measured.size(), 3, kNoise_m);
  // Half way to the truth a bilinear map has its secant: 70 mm times a tilt is no small matter.
  const ArmState middle = moved(c.state, candidates, 0.5 * missing(candidates, c.state, s));
  const Eigen::MatrixXd J_kept = evaluate(data, middle, kept).jacobian;
  Eigen::VectorXd error = missing(kept, c.state, s);
  if (!held.empty()) {
    const Eigen::VectorXd moved_points =
        evaluate(data, middle, held).jacobian * missing(held, c.state, s);
    error += J_kept.colPivHouseholderQr().solve(moved_points);
  }
  Verdict out;
  out.parameters = static_cast<int>(kept.size());
  out.distance2 = error.dot(c.covariance.ldlt().solve(error));
  for (int i = 0; i < out.parameters; ++i)
    out.inside += std::abs(error(i)) < 1.96 * std::sqrt(c.covariance(i, i));
  return out;
}

/// 99 % quantile of chi^2, to 0.1 % for k >= 10 [Wilson & Hilferty 1931].
double chi2_99(int k) {
  const double a = 2.0 / (9.0 * k);
  return k * std::pow(1.0 - a + 2.3263479 * std::sqrt(a), 3);
}

TEST(Covariance, HoldsTheTruthInNinetyNineOfAHundredCellsAndItsIntervalsInNinetyFive) {
  const long cells = scaled(200);
  int under = 0, inside = 0, parameters = 0;
  for (long seed = 1; seed <= cells; ++seed) {
    const Verdict v = judge(some_case(seed));
    under += v.distance2 < chi2_99(v.parameters);
    inside += v.inside;
    parameters += v.parameters;
  }
  const double share = static_cast<double>(inside) / parameters;
  std::printf(
      "%ld cells: %d under the 99 %% quantile; %.1f %% of %d true values in their 95 %% interval\n",
      cells, under, 100.0 * share, parameters);
  EXPECT_GE(under, 0.95 * static_cast<double>(cells));
  EXPECT_GT(share, 0.90);
  EXPECT_LT(share, 0.98);
}

}  // namespace
}  // namespace plumb::offline
