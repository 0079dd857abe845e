// SPDX-License-Identifier: Apache-2.0
#include "recheck/visible.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "recheck/constants.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kSigma_m = 3e-5;

struct Visible : testing::Test {
  double unseen(const Change& change, double sigma_m = kSigma_m, int count = 4) const {
    const Measurements few = arm.poses(count, 5);
    const Eigen::MatrixXd S =
        sigma_m * sigma_m * Eigen::MatrixXd::Identity(3 * few.size(), 3 * few.size());
    return visibility({change}, few, own, arm.state, S).at(0).unseen_m;
  }

  SmallArm arm;
  Measurements own = arm.poses(30, 6);
};

/// Every direction of a moved tool, as far as it goes before it is noticed.
TEST_F(Visible, NoDirectionMovesThePointFartherWithoutBeingNoticed) {
  const Change tool = arm.tool();
  const Measurements few = arm.poses(4, 5);
  const Eigen::MatrixXd seen = slopes(few, arm.state, tool.parameters);
  const Eigen::MatrixXd motion = slopes(own, arm.state, tool.parameters);
  tests::Random random(7);
  double most = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector3d x(normal(random), normal(random), normal(random));
    const double chi2 = (seen * x).squaredNorm() / (kSigma_m * kSigma_m) +
                        kNoticed * x.cwiseQuotient(kWidest * tool.typical).squaredNorm();
    most = std::max(most, std::sqrt(kNoticed / chi2 * (motion * x).squaredNorm() / own.size()));
  }
  EXPECT_LT(most, unseen(tool) * (1.0 + 1e-6));
  EXPECT_GT(most, unseen(tool) * 0.99);
}

TEST_F(Visible, MoreNoiseAndFewerPosesHideMore) {
  for (const Change& change : {arm.tool(), arm.offset(0), arm.offset(2)}) {
    EXPECT_NEAR(unseen(change, 2.0 * kSigma_m), 2.0 * unseen(change), 0.01 * unseen(change));
    EXPECT_GT(unseen(change, kSigma_m, 3), unseen(change, kSigma_m, 4));
  }
}

/// Poses at which joint 3 does not turn the point say nothing of it; but an offset hardly ever
/// exceeds ten typical ones.
TEST_F(Visible, WhatNoReadingShowsIsBoundedByItsTypicalSize) {
  const Change offset = arm.offset(1);
  const double widest = std::sqrt(
      (slopes(own, arm.state, offset.parameters) * kWidest * offset.typical).squaredNorm() /
      own.size());
  EXPECT_NEAR(unseen(offset, 1e3), widest, 1e-6 * widest);
}

}  // namespace
}  // namespace plumb::offline::recheck
