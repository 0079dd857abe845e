// SPDX-License-Identifier: Apache-2.0
#include "recheck/recheck_plan.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <set>

#include "arm/predicted_points.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

/// Twenty poses, the second ten a repeat of the first.
struct RecheckPlanned : testing::Test {
  RecheckPlanned() {
    own = arm.poses(20, 33);
    for (int i = 10; i < 20; ++i) {
      own.q.row(i) = own.q.row(i - 10);
      own.replicate_group[static_cast<std::size_t>(i)] = i - 10;
    }
    own.p_M = predict_points(arm.state, own);
    tests::Random random(34);
    add_noise(own, 2e-5, random);
    run = arm.run(own);
  }
  RecheckPlan planned(int n) const { return plan_recheck(arm.cell, run, run, own, n); }
  /// ln det of what these rows tell of all changes, with their typical sizes as prior.
  double told(const std::vector<int>& rows) const {
    const Measurements some = pick(own, rows);
    Eigen::MatrixXd all;
    for (const Change& change : possible_changes(arm.cell, arm.state, own, 12)) {
      const Eigen::MatrixXd B =
          slopes(some, arm.state, change.parameters) * change.typical.asDiagonal();
      all.conservativeResize(B.rows(), all.cols() + B.cols());
      all.rightCols(B.cols()) = B / expected_sigma(run, own);
    }
    const Eigen::MatrixXd S =
        Eigen::MatrixXd::Identity(all.rows(), all.rows()) + all * all.transpose();
    return std::log(S.determinant());
  }

  SmallArm arm;
  Measurements own;
  offline::Run run;
};

TEST_F(RecheckPlanned, EachPoseIsTheOneThatTellsMostNextToThoseBefore) {
  std::vector<int> chosen;
  for (int n = 1; n <= 5; ++n) {
    const std::vector<int> rows = planned(n).rows;
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(n));
    EXPECT_TRUE(std::includes(rows.begin(), rows.end(), chosen.begin(), chosen.end()));
    for (int other = 0; other < 10; ++other) {
      std::vector<int> instead = chosen;
      instead.push_back(other);
      if (std::find(chosen.begin(), chosen.end(), other) == chosen.end()) {
        EXPECT_GE(told(rows), told(instead) - 1e-6);
      }
    }
    chosen = rows;
  }
}

TEST_F(RecheckPlanned, NoPoseIsChosenTwiceAndNoneThatContradictedTheOthers) {
  run.fit.calibration.outliers.push_back({.row = 3});
  const std::vector<int> rows = planned(15).rows;
  EXPECT_EQ(rows.size(), 9U);
  std::set<int> groups;
  for (const int row : rows) groups.insert(own.replicate_group[static_cast<std::size_t>(row)]);
  EXPECT_EQ(groups.size(), 9U);
  EXPECT_EQ(groups.count(3), 0U);
}

TEST_F(RecheckPlanned, MorePosesHideLess) {
  const RecheckPlan few = planned(4), more = planned(8);
  ASSERT_EQ(few.visible.size(), more.visible.size());
  for (std::size_t k = 0; k < few.visible.size(); ++k) {
    ASSERT_TRUE(same(few.visible[k].change, more.visible[k].change));
    EXPECT_LE(more.visible[k].unseen_m, few.visible[k].unseen_m * (1.0 + 1e-9));
  }
}

}  // namespace
}  // namespace plumb::offline::recheck
