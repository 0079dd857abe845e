// SPDX-License-Identifier: Apache-2.0
#include "compare/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "arm/predicted_points.hpp"
#include "residual_cases.hpp"
#include "tests/yardstick.hpp"

namespace plumb::offline::compare {
namespace {

/// A fit of the case as it stands: every fifth pose held out.
Fit fit_of(ResidualCase& at) {
  Fit out;
  out.calibration.state = at.state;
  out.predicted_M = predict_points(at.state, at.measured.q);
  at.measured.p_M = out.predicted_M + at.error;
  out.split.fold.assign(at.size(), -1);
  out.split.used.assign(at.size(), true);
  for (int i = 0; i < at.size(); ++i) out.split.held.push_back(i % 5 == 0);
  out.held.n = at.size() / 5;
  return out;
}

TEST(Comparison, JudgesTheHeldOutPosesAloneAndListsTheWorstFirst) {
  ResidualCase at(2, 200);
  at.add_noise(1e-5);
  at.cell.tolerance_m = 1.6e-5;
  const Comparison c = comparison(at.cell, at.measured, fit_of(at));
  std::vector<double> norms;
  double within = 0.0, fit_within = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double e = at.error.row(i).norm();
    if (i % 5 == 0) norms.push_back(e);
    (i % 5 == 0 ? within : fit_within) += e <= at.cell.tolerance_m ? 1.0 : 0.0;
  }
  std::sort(norms.rbegin(), norms.rend());
  ASSERT_EQ(c.poses.size(), 40U);
  for (std::size_t i = 0; i < norms.size(); ++i)
    EXPECT_NEAR(c.poses[i].error_M.norm(), norms[i], 1e-12);
  EXPECT_NEAR(c.within_tolerance, within / 40.0, 1e-12);
  EXPECT_NEAR(c.fit_within_tolerance, fit_within / 160.0, 1e-12);
  EXPECT_EQ(c.stats.n, 40);
}

TEST(Comparison, ProfilesLoadAndContextWhereTheyVaryAndLeaveThemOutWhereTheyDoNot) {
  ResidualCase at(2, 200);
  at.add_noise(1e-5);
  auto& context = at.measured.context;
  context.payload = RowsN::Zero(200, 4);
  context.direction = RowsN::Ones(200, 6);
  context.sensors = {"temp", "temp_room"};
  context.temperature = RowsN::Constant(200, 2, 20.0);
  for (int i = 0; i < 200; ++i) {
    context.payload(i, 0) = i % 2 == 0 ? 0.0 : 5.0;
    context.direction(i, 2) = i % 3 == 0 ? -1.0 : 1.0;
    context.temperature(i, 1) = 20.0 + 0.01 * i;
    if (i % 2 == 1) at.error.row(i) *= 4.0;
  }
  const Comparison c = comparison(at.cell, at.measured, fit_of(at));
  std::map<std::string, const ErrorProfile*> by;
  for (const auto& p : c.profiles) by[p.name] = &p;
  EXPECT_TRUE(by.contains("payload"));
  EXPECT_TRUE(by.contains(at.cell.nominal.joints[2].name + " direction"));
  EXPECT_FALSE(by.contains(at.cell.nominal.joints[1].name + " direction"));
  EXPECT_TRUE(by.contains("temp_room"));
  EXPECT_FALSE(by.contains("temp"));
  EXPECT_TRUE(by.contains("order"));
  EXPECT_TRUE(by.at("payload")->matters);
  for (const auto& p : c.profiles) {
    if (p.name == "payload" || p.kind == ErrorProfile::Kind::kLoad) continue;
    EXPECT_FALSE(p.matters) << p.name;
  }
}

TEST(Comparison, OfTwelveThousandPosesTakesLessThanThreeTenthsOfASecond) {
  ResidualCase at(2, 12000);
  at.add_noise(1e-5);
  at.add_change(moved_state(at, MotionSource::kTool, -1, 1e-4), [](int i) { return i > 4999; });
  const Fit fit = fit_of(at);
  const double start = tests::processor_s();
  const Comparison c = comparison(at.cell, at.measured, fit);
  const double seconds = tests::processor_s() - start;
  std::printf("[ time     ] %.3f s\n", seconds);
  EXPECT_EQ(c.changes.steps.size(), 1U);
  if (PLUMB_TIMED != 0) {
    EXPECT_LT(seconds, 0.3 * tests::times_slower());
  }
}

}  // namespace
}  // namespace plumb::offline::compare
