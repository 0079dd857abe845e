// SPDX-License-Identifier: Apache-2.0
// Series of waves are fitted by sums of their own; here beside the plain Jacobian of everything.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "fit/calibrate.hpp"
#include "simulate/simulate.hpp"
#include "solve/evaluation.hpp"
#include "solve/series_numbers.hpp"
#include "solve/series_solver.hpp"
#include "solve/solver.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

struct SeriesFit {
  Cell cell;
  Measurements measured;
  ArmState start;
  std::vector<Parameter> parameters;
  FitData data;

  explicit SeriesFit(double sigma_m) {
    cell = random_cell(4, 6, format::Convention::kStandard, ArmKind::kRevolute);
    cell.effects = {
        {"geometry", {}, {}, {}},
        {"joint_series", {1, 3}, {{"waves", 9.0}, {"size_urad", 60.0}, {"slope", 0.5}}, {}}};
    SimulationPlan plan;
    plan.poses = 300;
    plan.truth.seed = 4;
    measured = simulate(cell, plan).measured;
    const Calibration placed = calibrate(
        [this] {
          Cell bare = cell;
          bare.effects.resize(1);
          return bare;
        }(),
        measured, rows());
    start = placed.state;
    start.arm.effects = bind_effects(cell, measured);
    parameters = placed.parameters;
    data.cell = &cell;
    data.measured = &measured;
    data.rows = rows();
    data.sigma_m = Rows3::Constant(measured.size(), 3, sigma_m);
    data.series = true;
  }
  SeriesFit(const SeriesFit&) = delete;

  std::vector<int> rows() const {
    std::vector<int> out(static_cast<std::size_t>(measured.size()));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<int>(i);
    return out;
  }

  /// Parameters and the numbers of the series, each an ordinary column of the Jacobian with an
  /// ordinary line for its prior.
  Solution plain(const ArmState& at) const {
    std::vector<Parameter> all = parameters;
    for (const auto& p : effect_parameters(at.arm)) all.push_back(p);
    return evaluate(data, at, all);
  }
};

TEST(SeriesSolver, EndsWhereThePlainGradientOfEverythingIsZero) {
  const SeriesFit fit(50e-6);
  const Solution solved = solve(fit.data, fit.start, fit.parameters, 1e-14);
  ASSERT_TRUE(solved.converged) << solved.reason;
  const Solution before = fit.plain(fit.start), after = fit.plain(solved.state);
  const Eigen::VectorXd length = before.jacobian.colwise().norm().transpose();
  const auto slope = [&](const Solution& at) {
    return (at.jacobian.transpose() * at.residual).cwiseQuotient(length).norm();
  };
  EXPECT_LT(slope(after), 1e-4 * slope(before));
  EXPECT_NEAR(solved.cost, after.cost, 1e-9 * after.cost) << "the same cost, priors included";
  EXPECT_LT(after.cost, before.cost);
  for (const auto& one : series_numbers(solved.state.arm)) EXPECT_EQ(one.count, 18);
  EXPECT_FALSE(series_peaks(solved.state.arm).empty());
}

/// What is known of the parameters once the series is unknown as well: the corner of the inverse of
/// everything.
TEST(SeriesSolver, TellsTheMarginalInformationAndHowManyNumbersThePosesDecide) {
  const SeriesFit fit(50e-6);
  const Solution solved = solve(fit.data, fit.start, fit.parameters, 1e-14);
  const Solution plain = fit.plain(solved.state);
  const Eigen::MatrixXd all = (plain.jacobian.transpose() * plain.jacobian).inverse();
  const auto p = static_cast<Eigen::Index>(fit.parameters.size());
  const Eigen::MatrixXd expected = all.topLeftCorner(p, p);
  const Eigen::MatrixXd got = solved.marginal.inverse();
  for (Eigen::Index k = 0; k < p; ++k)
    EXPECT_NEAR(got(k, k) / expected(k, k), 1.0, 1e-2) << fit.parameters[k].name;
  double dof = 0.0;
  Eigen::Index at = p;
  for (const auto& one : series_numbers(solved.state.arm))
    for (int k = 0; k < one.count; ++k, ++at) dof += 1.0 - all(at, at) / std::pow(one.sigma(k), 2);
  EXPECT_NEAR(solved.series_dof, dof, 0.01 * dof);
  EXPECT_GT(dof, 1.0);
}

/// The prior decides where the poses say nothing, and gives way where they do.
TEST(SeriesSolver, TheNoiserTheReadingsTheSmallerTheWaves) {
  double before = 1e300;
  for (const double sigma_m : {1e-6, 1e-4, 1e-2}) {
    const SeriesFit fit(sigma_m);
    const Solution solved = solve(fit.data, fit.start, fit.parameters, 1e-12);
    double sum = 0.0;
    for (const auto& peak : series_peaks(solved.state.arm)) sum += peak.size * peak.size;
    EXPECT_LT(sum, before);
    before = sum;
  }
}

TEST(SeriesSolver, WithoutThatRequestTheNumbersStayAsTheyAre) {
  SeriesFit fit(50e-6);
  fit.data.series = false;
  fit.start.arm.effects[0].parameters[3] = 1.5e-5;
  const Solution solved = solve(fit.data, fit.start, fit.parameters, 1e-12);
  EXPECT_EQ(solved.state.arm.effects[0].parameters, fit.start.arm.effects[0].parameters);
  EXPECT_EQ(solved.marginal.size(), 0);
}

}  // namespace
}  // namespace plumb::offline
