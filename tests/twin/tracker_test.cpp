// SPDX-License-Identifier: Apache-2.0
#include "twin/tracker.hpp"

#include <gtest/gtest.h>

namespace plumb::offline::twin {
namespace {

constexpr int kStations = 300;

TEST(Tracker, FiguresAreThoseOfTheTextbook) {
  const ErrorFigures figures = figures_of({3.0, 4.0, 0.0, 5.0});
  EXPECT_EQ(figures.n, 4);
  EXPECT_DOUBLE_EQ(figures.mean_m, 3.0);
  EXPECT_DOUBLE_EQ(figures.rms_m, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(figures.p95_m, 5.0);
  EXPECT_DOUBLE_EQ(figures.max_m, 5.0);
  EXPECT_EQ(figures_of({}).n, 0);
}

Cell placed() {
  Cell cell = make_demo("clean").cell;
  cell.measurement.fit_frame = cell.measurement.fit_target = false;
  cell.measurement.X_MB = {{1.0, 2.0, 3.0}, {0.5, 0.5, 0.5, 0.5}};
  return cell;
}

std::vector<Stop> stops_of(const Cell& cell, const NominalArm& aims) {
  const Path path = generated_path(cell, kStations, 0.6, 2);
  std::vector<Stop> out;
  for (int k = 0; k < path.stations(); ++k) {
    const VectorXd q = path.q.row(k).transpose();
    out.push_back({.station = k, .q = q, .X_BD = aims.forward(q), .offset = {}});
  }
  return out;
}

TEST(Tracker, AnArmThatHidesNothingHasNoErrorButTheNoise) {
  const Cell cell = placed();
  const Hidden hidden{.geometry_m = 0.0, .geometry_rad = 0.0};
  const TrueErrors found = true_errors(cell, hidden, truth_of(cell, hidden), kStations,
                                       stops_of(cell, NominalArm(cell.nominal)));
  EXPECT_LT(found.truth.max_m, 1e-9);
  const NoiseFloor floor = floor_of(hidden.noise_m);
  EXPECT_NEAR(found.measured.mean_m, floor.mean_m, 0.1 * floor.mean_m);
  EXPECT_NEAR(found.measured.rms_m, floor.rms_m, 0.1 * floor.rms_m);
}

TEST(Tracker, WhoeverKnowsTheTrueChainMissesByTheHiddenEffectOnly) {
  const Cell cell = placed();
  const Hidden plain{.effects = {}};
  const Hidden bent{.effects = {"joint_compliance:J2=150urad"}};
  const NominalArm knows(true_chain(cell, truth_of(cell, plain)));
  const auto stops = stops_of(cell, knows);
  EXPECT_LT(true_errors(cell, plain, truth_of(cell, plain), kStations, stops).truth.max_m, 1e-9);
  const double bent_m = true_errors(cell, bent, truth_of(cell, bent), kStations, stops).truth.max_m;
  EXPECT_GT(bent_m, 20e-6);
  EXPECT_LT(bent_m, 150e-6 * 1.5);  // the angle times the reach
}

TEST(Tracker, ACellThatFitsItsFrameIsRefused) {
  Cell cell = placed();
  cell.measurement.fit_frame = true;
  const Hidden hidden;
  EXPECT_THROW(true_errors(cell, hidden, truth_of(cell, hidden), kStations, {}), Failure);
}

TEST(Comparison, IsReachedOnlyIfBothAreTrue) {
  Comparison c;
  c.floor = floor_of(10e-6);
  c.off.truth = {.n = 1, .mean_m = 100e-6};
  c.on.truth = {.n = 1, .mean_m = 10e-6};
  c.on.measured = {.n = 1, .mean_m = 17e-6, .rms_m = 18e-6};
  EXPECT_TRUE(c.reached());
  EXPECT_EQ(verdict(c).found, "good");
  c.on.measured.mean_m = 21e-6;
  EXPECT_FALSE(c.reached());
  EXPECT_EQ(verdict(c).found, "bad");
  c.on.measured.mean_m = 17e-6;
  c.on.truth.mean_m = 21e-6;
  EXPECT_FALSE(c.reached());
}

}  // namespace
}  // namespace plumb::offline::twin
