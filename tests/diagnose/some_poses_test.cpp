// SPDX-License-Identifier: Apache-2.0
// Of many poses some choose the effects; what is said of these holds for all.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "diagnose/constants.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/thinned_fit.hpp"
#include "fit/calibrate.hpp"
#include "fit/fit.hpp"
#include "fit/fit_cell.hpp"
#include "tests/cases/blind_case.hpp"

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

TEST(SomePoses, ChooseWhatIsThenFittedToAll) {
  const int bumped = 4321;
  const Bumped arm(bumped);
  const MeasurementFiles& measured = arm.blind.measured.measured;
  ASSERT_GT(measured.size(), 2 * kMostChoosing);
  const Diagnosis d = diagnose(arm.blind.cell, measured, {.apply = true, .tell = {}});
  ASSERT_EQ(d.added.size(), 2U) << d.text_after;
  EXPECT_EQ(d.finding_after, Finding::kComplete) << d.text_after;
  bool found = false;
  for (const auto& added : d.added) {
    if (added.entry.name != "step") continue;
    found = true;
    // Among all poses that are fitted, not among those that chose: to the next held-out one.
    EXPECT_NEAR(std::get<double>(added.entry.options.at("after_row")), bumped, 1.0);
  }
  EXPECT_TRUE(found);
  // The last line is that of the model as `fit` makes it, of all poses.
  Cell with = arm.blind.cell;
  with.effects = d.effects;
  const Fit whole = fit_cell(with, measured);
  EXPECT_NEAR(d.after.mean, whole.held.mean, 1e-3 * whole.held.mean);
  EXPECT_NEAR(d.added.back().held.mean, d.after.mean, 1e-12);
}

}  // namespace
}  // namespace plumb::offline
