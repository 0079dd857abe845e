// SPDX-License-Identifier: Apache-2.0
#include "fit/common_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/fit_cell.hpp"
#include "simulate/simulate.hpp"
#include "simulate/study_arms.hpp"

namespace plumb::offline {
namespace {

constexpr double kBuilt_m = 0.5e-3;

struct Measured {
  explicit Measured(std::uint64_t seed, double geometry_m = kBuilt_m) {
    cell = sim::heavy_arm();
    cell.measurement.sigma_m = 20e-6;
    SimulationPlan plan;
    plan.poses = 100;
    plan.noise_m = 20e-6;
    plan.seed = seed;
    plan.truth.geometry_m = geometry_m;
    plan.truth.geometry_rad = 0.3e-3;
    static_cast<Measurements&>(readings) = simulate(cell, plan).measured;
  }
  Fit fit() const { return fit_cell(cell, readings); }
  bool warned() const {
    for (const auto& remark : fit().remarks)
      if (remark.code == "W-FIT-SCALE") return true;
    return false;
  }
  Cell cell;
  MeasurementFiles readings;
};

/// Points that are half a percent too far apart, as by a tracker with a wrong scale.
TEST(CommonScale, OfTheInstrumentIsFoundAndSaid) {
  for (const double factor : {1.006, 0.994}) {
    Measured made(3);
    made.readings.p_M *= factor;
    const auto scale = common_scale(made.fit().calibration, kBuilt_m);
    ASSERT_TRUE(scale);
    EXPECT_NEAR(scale->longer, factor - 1.0, 2e-3);
    EXPECT_TRUE(scale->unusual());
    EXPECT_TRUE(made.warned()) << factor;
  }
}

TEST(CommonScale, OfArmsAsTheyAreBuiltIsNotSaid) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) EXPECT_FALSE(Measured(seed).warned()) << seed;
}

/// An arm several millimetres from its data sheet has a common part, too.
TEST(CommonScale, OfLengthsThatAreWrongOneByOneIsNotSaid) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    EXPECT_FALSE(Measured(seed, 4e-3).warned()) << seed;
}

TEST(CommonScale, IsUnknownWithoutLengths) { EXPECT_FALSE(common_scale(Calibration{}, kBuilt_m)); }

}  // namespace
}  // namespace plumb::offline
