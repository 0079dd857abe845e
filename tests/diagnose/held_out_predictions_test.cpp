// SPDX-License-Identifier: Apache-2.0
// Poses that are predicted by models that never saw them, with planted errors.
#include "diagnose/held_out_predictions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "arm/predicted_points.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr int kRows = 60;
constexpr double kSigma_m = 20e-6;

/// An arm that is known exactly, and readings of it that err as they are told.
struct HeldOutPoses : testing::Test {
  HeldOutPoses() {
    const Cell cell = random_cell(4, 6, format::Convention::kStandard, ArmKind::kRevolute);
    right.state.arm.calibrated = cell.nominal;
    tests::Random random(2);
    measured.q.resize(kRows, 6);
    for (double& q : measured.q.reshaped()) q = random.uniform(-1.5, 1.5);
    measured.p_M = predict_points(right.state, measured.q);
    for (double& x : measured.p_M.reshaped()) x += kSigma_m * random.uniform(-1.7, 1.7);
    split.folds = 2;
    for (int i = 0; i < kRows; ++i) {
      split.fold.push_back(i % 2);
      (i % 2 == 0 ? even : odd).push_back(i);
    }
    split.held.assign(kRows, false);
    split.used.assign(kRows, true);
  }
  /// The same arm on a base that is so far off.
  Calibration off_by(double shift_m) const {
    Calibration out = right;
    out.state.X_MB.p[0] += shift_m;
    return out;
  }
  HeldOutPredictions predicted(const Calibration& of_even, const Calibration& of_odd) const {
    HeldOutPredictions out(settings, measured, split);
    out.put(of_even, odd, even);
    out.put(of_odd, even, odd);
    return out;
  }
  void spoil(const std::vector<int>& rows, double by_m = 2e-3) {
    for (const int row : rows) measured.p_M(row, 1) += by_m;
  }
  static BadRows bad(std::set<int> rows) { return {std::move(rows), kSigma_m}; }

  MeasurementSettings settings;
  Measurements measured;
  Split split;
  std::vector<int> even, odd;
  Calibration right;
};

TEST_F(HeldOutPoses, EachErrIsThatOfTheModelThatWasFittedWithoutIt) {
  const double far = 1.0;  // beside which the noise is nothing
  const ErrorStats all = predicted(off_by(far), off_by(3.0 * far)).stats(bad({}));
  EXPECT_EQ(all.n, kRows);
  EXPECT_NEAR(all.mean, 2.0 * far, 1e-3);
  EXPECT_NEAR(all.max, 3.0 * far, 1e-3);
  EXPECT_NEAR(all.rms, std::sqrt(5.0) * far, 1e-3);
}

TEST_F(HeldOutPoses, ThatArePredictedAnewCountAsLastPredicted) {
  HeldOutPredictions out = predicted(off_by(1.0), off_by(1.0));
  out.put(right, odd, even);
  out.put(right, even, odd);
  EXPECT_LT(out.stats(bad({})).max, 10.0 * kSigma_m);
}

TEST_F(HeldOutPoses, AreThoseOfTheSplitAlone) {
  split = {};
  split.fold.assign(kRows, -1);
  split.used.assign(kRows, true);
  split.held.assign(kRows, false);
  for (const int row : {3, 8, 40}) split.held[static_cast<std::size_t>(row)] = true;
  HeldOutPredictions out(settings, measured, split);
  out.put(right, {}, {3, 8, 40});
  EXPECT_EQ(out.stats(bad({})).n, 3);
}

TEST_F(HeldOutPoses, AFewThatStandOutAreBad) {
  spoil({5, 30, 41});
  EXPECT_EQ(predicted(right, right).bad_rows(kSigma_m), (std::set<int>{5, 30, 41}));
}

TEST_F(HeldOutPoses, ManyThatStandOutAreNoBadReadings) {
  std::vector<int> many;
  for (int i = 0; i < kRows; i += 4) many.push_back(i);
  spoil(many);
  EXPECT_TRUE(predicted(right, right).bad_rows(kSigma_m).empty());
}

TEST_F(HeldOutPoses, AreLeftOutOnlyIfTheyWereBadAndStillAre) {
  spoil({5, 30});
  const HeldOutPredictions both = predicted(right, right);
  EXPECT_EQ(both.stats(bad({5, 30})).n, kRows - 2);
  EXPECT_LT(both.stats(bad({5, 30})).max, 10.0 * kSigma_m);
  EXPECT_EQ(both.stats(bad({5})).n, kRows - 1) << "row 30 has become bad with this model";
  EXPECT_NEAR(both.stats(bad({5})).max, 2e-3, 0.1e-3);
  EXPECT_EQ(both.stats(bad({5, 30, 44})).n, kRows - 2) << "row 44 is predicted well now";
}

}  // namespace
}  // namespace plumb::offline
