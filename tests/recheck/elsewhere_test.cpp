// SPDX-License-Identifier: Apache-2.0
#include "recheck/elsewhere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "recheck/recheck.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

std::vector<int> all_rows(const Measurements& rows) {
  std::vector<int> out(static_cast<std::size_t>(rows.size()));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

int count_elsewhere(const Measurements& own, const Measurements& rows) {
  const std::vector<bool> out = elsewhere(own, all_rows(own), rows);
  return static_cast<int>(std::count(out.begin(), out.end(), true));
}

TEST(Elsewhere, ThePosesOfTheCalibrationAndTheirLikeAreNot) {
  const SmallArm arm;
  const Measurements own = arm.poses(300, 1);
  EXPECT_EQ(count_elsewhere(own, own), 0);
  EXPECT_LE(count_elsewhere(own, arm.poses(100, 2)), 10) << "drawn alike";
}

TEST(Elsewhere, PosesFarFromAllOfTheCalibrationAre) {
  const SmallArm arm;
  const Measurements own = arm.poses(300, 1);
  Measurements rows = arm.poses(20, 2);
  rows.q.col(1).array() += 7.0;
  EXPECT_EQ(count_elsewhere(own, rows), 20);
}

/// On a dense grid the neighbours are near, so a reading between two far lines of it is elsewhere.
TEST(Elsewhere, IsMeasuredByTheDistanceOfNeighbours) {
  const SmallArm arm;
  Measurements own = arm.poses(40, 1), row = arm.poses(1, 2);
  for (int i = 0; i < own.size(); ++i) own.q.row(i) << 0.01 * i, 0.0, 0.0;
  row.q.row(0) << 0.2, 0.1, 0.0;
  EXPECT_EQ(count_elsewhere(own, row), 1);
  own.q.col(0) *= 100.0;
  row.q(0, 0) *= 100.0;
  EXPECT_EQ(count_elsewhere(own, row), 0);
}

TEST(Elsewhere, TwoVisitsToAPoseAreNoNeighbours) {
  const SmallArm arm;
  Measurements own = arm.poses(40, 1);
  own.q.bottomRows(20) = own.q.topRows(20).array() + 1e-4;
  EXPECT_EQ(count_elsewhere(own, arm.poses(30, 2)) < 15, true);
  EXPECT_EQ(pose_distance(own, 0, own, 20), 0.0);
}

/// An arm that misses by a fifth of a millimetre wherever the calibration had no pose, and has not
/// changed: only one that has is called changed.
TEST(Elsewhere, WhatAModelLacksThereIsNoChange) {
  SmallArm arm;
  arm.cell.tolerance_m = 1e-4;
  int called_changed = 0, told = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    tests::Random random(seed);
    Measurements own = arm.poses(80, 100 + seed), rows = arm.poses(12, 200 + seed);
    rows.q.col(1).array() += 7.0;
    rows.p_M = predict_points(arm.state, rows);
    add_noise(own, 2e-5, random);
    add_noise(rows, 1e-4, random);
    const offline::Run run = arm.run(own);
    const Recheck found = recheck_run(arm.cell, run, run, own, rows, {});
    EXPECT_EQ(found.elsewhere, 12);
    called_changed += found.verdict == Recheck::Verdict::kChanged;
    told += found.only_elsewhere && found.verdict == Recheck::Verdict::kUndecidable;
    rows.p_M.rowwise() += Eigen::RowVector3d(0.0, 5e-3, 0.0);
    EXPECT_EQ(recheck_run(arm.cell, run, run, own, rows, {}).verdict == Recheck::Verdict::kTrue,
              false)
        << "five millimetres are no shortcoming of a model";
  }
  EXPECT_LE(called_changed, 1);
  EXPECT_GE(told, 25);
}

}  // namespace
}  // namespace plumb::offline::recheck
