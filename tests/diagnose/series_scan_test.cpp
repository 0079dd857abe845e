// SPDX-License-Identifier: Apache-2.0
// A series of whole waves, against dense sums over all lines.
#include "diagnose/series_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnose/constants.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

/// A series of so many waves at these joints; wave k has a size of 100 urad k^-slope.
EffectEntry series_of(std::vector<int> joints, double waves, double slope) {
  EffectEntry out = entry_of(series_effect(), std::move(joints));
  set_option(out, OptionKey::kWaves, waves);
  set_option(out, OptionKey::kSize_urad, 100.0);
  set_option(out, OptionKey::kSlope, slope);
  return out;
}

struct SeriesScan : testing::Test {
  /// Noise, and gears of these joints that are irregular over a whole turn.
  WhitenedFit irregular(const std::vector<int>& joints, double size) const {
    Eigen::VectorXd lines = noise_of(arm, 61);
    for (const int joint : joints) {
      Regressor some = ripple_regressor(arm, joint, {3.0, 4.0, 5.0, 6.0, 7.0, 8.0});
      lines += motion_of_size(arm, some, size);
    }
    return leaving(arm, lines);
  }
  /// The scorer refers to its fit.
  static std::optional<SeriesFound> scanned(const WhitenedFit& s, const std::vector<int>& joints) {
    return scan_series(Scorer(s), joints);
  }
  Eigen::VectorXd angles(int joint) const {
    Eigen::VectorXd out(arm.poses());
    for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = arm.q(i)[joint];
    return out;
  }

  const WhitenedFit& arm = whitened_arm().whitened;
};

TEST_F(SeriesScan, ColumnsAreWavesWhoseSizesFallAsTheirPriorSays) {
  constexpr double kSlope = 0.7;
  const Regressor series = series_regressor(arm, series_of({1, 4}, 5.0, kSlope));
  ASSERT_EQ(series.columns.cols(), 2 * 2 * 5);
  for (int part = 0; part < 2; ++part) {
    const Eigen::VectorXd q = angles(part == 0 ? 1 : 4);
    for (int wave = 1; wave <= 5; ++wave) {
      const auto pair = series.columns.middleCols(10 * part + 2 * (wave - 1), 2);
      const double size = 100e-6 * std::pow(wave, -kSlope);
      for (Eigen::Index i = 0; i < q.size(); ++i) {
        EXPECT_NEAR(pair.row(i).norm(), size, 1e-9 * size) << "sine and cosine of one angle";
        // Both turn by `wave` times the angle of the joint.
        const double sine = std::sin(wave * (q(i) - q(0)));
        EXPECT_NEAR(std::abs(pair(0, 0) * pair(i, 1) - pair(0, 1) * pair(i, 0)),
                    size * size * std::abs(sine), 1e-6 * size * size);
      }
    }
  }
}

TEST_F(SeriesScan, ScoreIsThatOfItsMotionsLineByLine) {
  const WhitenedFit s = irregular({1}, 1.0);
  const EffectEntry entry = series_of({1, 2}, 6.0, 1.0);
  const RegressorScore scored = score_series(Scorer(s), entry);
  const Eigen::MatrixXd X = motions(s, series_regressor(s, entry)).topRows(s.fit_lines);
  Eigen::MatrixXd XX = Eigen::MatrixXd::Zero(X.cols(), X.cols());
  Eigen::VectorXd Xy = Eigen::VectorXd::Zero(X.cols());
  ASSERT_EQ(scored.folds.size(), s.folds.size());
  for (const Products& fold : scored.folds) {
    XX += fold.XX;
    Xy += fold.Xy;
  }
  EXPECT_LT((XX - X.transpose() * X).norm(), 1e-9 * XX.norm());
  EXPECT_LT((Xy - X.transpose() * s.y.head(s.fit_lines)).norm(), 1e-9 * Xy.norm());

  const auto U = s.U.topRows(s.fit_lines);
  const Eigen::VectorXd seen = X * scored.theta;
  const Eigen::VectorXd left = s.y.head(s.fit_lines) - (seen - U * (U.transpose() * seen));
  EXPECT_NEAR(scored.explained, 1.0 - left.squaredNorm() / s.Q, 1e-9);
  EXPECT_NEAR(scored.absorbed, (U.transpose() * seen).squaredNorm() / seen.squaredNorm(), 1e-9);
}

TEST_F(SeriesScan, AWholeTurnFurtherNothingIsNew) {
  const WhitenedFit s = irregular({1}, 2.0);
  Measurements turned = *s.measured;
  turned.q.col(1).array() += 2.0 * M_PI;
  WhitenedFit there = s;
  there.measured = &turned;
  const EffectEntry entry = series_of({1}, 8.0, 1.0);
  EXPECT_NEAR(score_series(Scorer(there), entry).evidence.ln_bayes,
              score_series(Scorer(s), entry).evidence.ln_bayes, 1e-6);
}

TEST_F(SeriesScan, FindsTheJointsWhoseGearsAreIrregular) {
  for (const std::vector<int>& joints : {std::vector<int>{1}, std::vector<int>{0, 2}}) {
    const auto found = scanned(irregular(joints, 4.0), {0, 1, 2, 3});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->entry.joints, joints);
    EXPECT_TRUE(is_series(found->entry.name));
    EXPECT_GT(found->scored.evidence.ln_bayes, kCertain_nats);
    EXPECT_GT(found->scored.explained, 0.8);
  }
}

TEST_F(SeriesScan, FindsNoneInNoiseNorOfNoJoints) {
  EXPECT_FALSE(scanned(irregular({}, 0.0), {1, 4}));
  EXPECT_FALSE(scanned(irregular({1}, 4.0), {}));
  // So many waves of another joint explain some of it in so few poses, but far from as much.
  const auto own = scanned(irregular({1}, 4.0), {1}), other = scanned(irregular({1}, 4.0), {5});
  ASSERT_TRUE(own);
  if (other) {
    EXPECT_LT(other->scored.evidence.ln_bayes, 0.5 * own->scored.evidence.ln_bayes);
  }
}

TEST_F(SeriesScan, TheChoiceOfItsPriorCostsSomething) {
  const WhitenedFit s = irregular({1}, 4.0);
  const Scorer own(s);
  const auto found = scan_series(own, {1});
  ASSERT_TRUE(found);
  EXPECT_LT(found->scored.evidence.ln_bayes, score_series(own, found->entry).evidence.ln_bayes);
  const double size = number_option(found->entry, OptionKey::kSize_urad, 0.0) * 1e-6;
  EXPECT_GT(size, 0.0);
  EXPECT_LE(size, 1.001 * kLargestWave_rad);
}

TEST_F(SeriesScan, TheSmoothPartIsTheMotionOfTheFirstWavesOfEveryJoint) {
  const Regressor series = series_regressor(arm, series_of({1, 3}, 9.0, 1.0));
  const Regressor smooth = smooth_part(arm, series);
  const Eigen::MatrixXd X = motions(arm, series);
  const Eigen::Index kept = 2 * kSmoothWaves;
  ASSERT_EQ(smooth.columns.cols(), 2 * kept);
  EXPECT_LT((smooth.columns.leftCols(kept) - X.leftCols(kept)).norm(), 1e-9 * X.norm());
  EXPECT_LT((smooth.columns.rightCols(kept) - X.middleCols(18, kept)).norm(), 1e-9 * X.norm());
  // Of fewer waves than these, all.
  EXPECT_EQ(smooth_part(arm, series_regressor(arm, series_of({2}, 2.0, 1.0))).columns.cols(), 4);
}

}  // namespace
}  // namespace plumb::offline
