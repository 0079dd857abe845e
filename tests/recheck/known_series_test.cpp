// SPDX-License-Identifier: Apache-2.0
// What is known of a series of waves, beside the plain normal equations of all numbers together.
#include "recheck/known_series.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "small_arm.hpp"
#include "solve/series_numbers.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kNoise_m = 2e-5;

/// An arm with a series of waves at J2, calibrated where J2 is between 0 and 1 rad.
struct KnownSeries : testing::Test {
  KnownSeries() {
    arm.cell.effects = {
        {"geometry", {}, {}, {}},
        {"joint_series", {1}, {{"waves", 5.0}, {"size_urad", 100.0}, {"slope", 0.5}}, {}}};
    own = arm.poses(60, 3);
    own.q.col(1) = own.q.col(1).array().abs() / 2.5;
    arm.state.arm.effects = bind_effects(arm.cell, own);
    own.p_M = predict_points(arm.state, own);
    tests::Random random(4);
    add_noise(own, kNoise_m, random);
    run = arm.run(own);
  }

  /// Covariance of all numbers by the plain normal equations, by central differences.
  Eigen::MatrixXd plain(const std::vector<Parameter>& all, const Eigen::VectorXd& prior,
                        double sigma_m) const {
    const Eigen::MatrixXd J = slopes(own, arm.state, all) / sigma_m;
    Eigen::MatrixXd information = J.transpose() * J;
    information.diagonal().tail(prior.size()) += prior.array().square().inverse().matrix();
    return information.inverse();
  }

  SmallArm arm;
  Measurements own;
  offline::Run run;
};

TEST_F(KnownSeries, IsTheCovarianceOfAllNumbersFittedTogether) {
  const double sigma = expected_sigma(run, own);
  KnownNumbers known = arm.known(1.0);
  std::vector<Parameter> all = known.parameters;
  for (const auto& p : effect_parameters(arm.state.arm)) all.push_back(p);
  const SeriesNumbers series = series_numbers(arm.state.arm).front();
  const Eigen::MatrixXd expected = plain(all, series.sigma, sigma);
  known.covariance = expected.topLeftCorner(2, 2);
  const KnownNumbers out = with_series(known, arm.state, run, own, sigma);
  ASSERT_EQ(out.parameters.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(out.parameters[i].name, all[i].name);
  const Eigen::VectorXd std = expected.diagonal().cwiseSqrt();
  for (Eigen::Index i = 0; i < expected.rows(); ++i)
    for (Eigen::Index k = 0; k < expected.cols(); ++k)
      EXPECT_NEAR(out.covariance(i, k), expected(i, k), 1e-4 * std(i) * std(k)) << i << ' ' << k;
}

/// Where J2 was measured, numbers and waves make up for each other and the point is known within
/// the noise; where it was not, only by the prior.
TEST_F(KnownSeries, ThePointIsKnownWhereItWasMeasuredAndNotElsewhere) {
  const KnownNumbers out =
      with_series(arm.known(5e-5), arm.state, run, own, expected_sigma(run, own));
  const auto sigma_at = [&](double q2) {
    Measurements at = arm.poses(1, 7);
    at.q(0, 1) = q2;
    const Eigen::MatrixXd J = slopes(at, arm.state, out.parameters);
    return std::sqrt((J * out.covariance * J.transpose()).trace());
  };
  EXPECT_LT(sigma_at(0.5), 2.0 * kNoise_m);
  EXPECT_GT(sigma_at(-2.0), 2.0 * sigma_at(0.5));
}

TEST_F(KnownSeries, AModelWithoutSeriesKeepsWhatItKnows) {
  arm.state.arm.effects.clear();
  const KnownNumbers out =
      with_series(arm.known(1e-5), arm.state, run, own, expected_sigma(run, own));
  EXPECT_EQ(out.parameters.size(), 2U);
  EXPECT_EQ(out.covariance, arm.known(1e-5).covariance);
}

}  // namespace
}  // namespace plumb::offline::recheck
