// SPDX-License-Identifier: Apache-2.0
// Of many poses a scan looks at some; what it says holds for all.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "diagnose/constants.hpp"
#include "diagnose/scan.hpp"
#include "diagnose/thinned_fit.hpp"
#include "simulate/blind_case.hpp"

namespace plumb::offline {
namespace {

constexpr int kPoses = 7000;

/// A fitted arm that yields at its second joint, and whose tracker was bumped before `bumped`.
struct Bumped {
  BlindCase blind;
  std::vector<int> rows;
  Calibration calibration;
  WhitenedFit whitened;

  explicit Bumped(int bumped) : blind(make_blind_case(request())) {
    Measurements& m = blind.measured.measured;
    for (int i = bumped; i < m.size(); ++i) m.p_M.row(i) += Eigen::RowVector3d(3e-4, -2e-4, 1e-4);
    rows.resize(static_cast<std::size_t>(m.size()));
    std::iota(rows.begin(), rows.end(), 0);
    calibration = calibrate(blind.cell, m, rows);
    whitened = make_whitened_fit(blind.cell, m, calibration,
                                 without_outliers(rows, calibration.outliers), {});
  }
  Bumped(const Bumped&) = delete;
  Bumped& operator=(const Bumped&) = delete;

  static BlindRequest request() {
    BlindRequest out;
    out.poses = kPoses;
    out.fresh_poses = 1;
    out.repeats = 1;
    out.effects = {"joint_compliance:J2:5"};
    return out;
  }
};

TEST(SomePoses, OfAStageAreAStage) {
  const Bumped arm(kPoses);
  const WhitenedFit some = thinned(arm.whitened, 1000);
  EXPECT_EQ(some.poses(), 1000);
  EXPECT_EQ(some.folds.size(), arm.whitened.folds.size());
  EXPECT_EQ(some.folds.back().end, 1000);
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(some.rank, some.rank);
  EXPECT_LT((some.U.transpose() * some.U - I).norm(), 1e-9);
  EXPECT_LT((some.U.transpose() * some.y).norm(), 1e-9 * std::sqrt(some.Q));
  EXPECT_NEAR(some.Q / arm.whitened.Q, 1000.0 / kPoses, 0.1 * 1000.0 / kPoses);
}

TEST(SomePoses, WhatTheyShowIsJudgedOnAll) {
  const int bumped = 4321;
  const Bumped arm(bumped);
  ASSERT_GT(arm.whitened.fit_poses(), 6000);
  const Scan look = scan(arm.whitened, {}, {});
  const Scorer scorer(arm.whitened);
  int supported = 0;
  for (const auto& found : look.library) {
    if (!(found.score > kSupported)) continue;
    ++supported;
    const RegressorScore of_all = scorer.score(regressor_of(arm.whitened, found));
    EXPECT_NEAR(found.ln_bayes(), of_all.evidence.ln_bayes,
                1e-6 * std::abs(of_all.evidence.ln_bayes))
        << key_of(arm.blind.cell, found.entry);
  }
  EXPECT_GE(supported, 2);
  const Found* step = look.find(arm.blind.cell, "step/base");
  ASSERT_NE(step, nullptr);
  EXPECT_NEAR(std::get<double>(step->entry.options.at("after_row")), bumped, 1.0);
}

}  // namespace
}  // namespace plumb::offline
