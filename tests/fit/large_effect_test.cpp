// SPDX-License-Identifier: Apache-2.0
// What the poses clearly show is fitted as large as it is, whatever is usual.
#include <gtest/gtest.h>

#include <numeric>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

TEST(LargeEffect, OfATrackerManyTimesItsUsualSizeIsNotHeldSmall) {
  constexpr double kTrue_rad = 150.0 * 6e-6;  // az_sin2; geometry imitates nearly all of it
  BlindRequest request;
  request.poses = 400;
  const BlindCase blind = make_blind_case(request);
  Measurements measured = blind.measured.measured;
  std::vector<int> rows(static_cast<std::size_t>(measured.size()));
  std::iota(rows.begin(), rows.end(), 0);
  Cell cell = blind.cell;
  ArmState truth = calibrate(cell, measured, rows).state;
  cell.effects.push_back({.name = "tracker", .joints = {}, .options = {}, .place = {}});
  truth.arm.effects = bind_effects(cell, measured);
  truth.arm.effects.front().parameters[2] = kTrue_rad;
  measured.p_M = predict_points(truth, measured);
  tests::Random dice(1);
  for (Eigen::Index i = 0; i < measured.p_M.size(); ++i)
    measured.p_M.data()[i] += 35e-6 * dice.uniform(-1, 1);
  const Calibration fitted = calibrate(cell, measured, rows);
  EXPECT_NEAR(fitted.state.arm.effects.front().parameters[2], kTrue_rad, 0.2 * kTrue_rad);
}

}  // namespace
}  // namespace plumb::offline
