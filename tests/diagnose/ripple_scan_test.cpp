// SPDX-License-Identifier: Apache-2.0
// Waves of a joint that were planted in the residual, and those that are found there.
#include "diagnose/ripple_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnose/constants.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

constexpr int kJoint = 1;
constexpr double kRegressors = 300.0;

struct RippleScan : testing::Test {
  /// The noise and these waves of a joint, each so many times the noise.
  WhitenedFit rippled(const std::vector<double>& cycles, double size, int joint = kJoint) const {
    Eigen::VectorXd lines = noise_of(arm, 51);
    for (const double wave : cycles)
      lines += motion_of_size(arm, ripple_regressor(arm, joint, {wave}), size);
    return leaving(arm, lines);
  }
  static Ripples scanned(const WhitenedFit& s, int joint = kJoint) {
    int tried = 0;
    return scan_ripples(Scorer(s), joint, kRegressors, tried);
  }
  /// What a further wave must explain: the search through all that was tried, and its own odds.
  double price() const {
    return std::log(kRegressors + static_cast<double>(ripple_grid(arm, kJoint).size())) + kWavePays;
  }
  static bool has(const std::vector<double>& cycles, double wave, double within) {
    return std::any_of(cycles.begin(), cycles.end(),
                       [&](double one) { return std::abs(one - wave) < within; });
  }

  const WhitenedFit& arm = whitened_arm().whitened;
};

TEST_F(RippleScan, FindsItAtItsOwnJoint) {
  const WhitenedFit s = rippled({12.0}, 3.0);
  const double own = scanned(s).strongest_ln_bayes;
  for (int joint = 0; joint < s.joints(); ++joint)
    if (joint != kJoint) {
      EXPECT_LT(scanned(s, joint).strongest_ln_bayes, 0.5 * own) << joint;
    }
}

TEST_F(RippleScan, FindsSeveralWavesAndNoOthers) {
  const std::vector<double> waves{6.0, 14.5, 27.0};
  const Ripples found = scanned(rippled(waves, 3.0));
  ASSERT_EQ(found.cycles.size(), waves.size());
  for (const double wave : waves) EXPECT_TRUE(has(found.cycles, wave, 0.1)) << wave;
}

/// Waves between the steps of the grid invite to take two neighbours for each of them.
TEST_F(RippleScan, ThePickedWavesAreNoNeighboursOnTheGrid) {
  const auto grid = ripple_grid(arm, kJoint);
  const double step = grid.at(1) - grid.at(0);
  const double near = grid.at(10) + 0.5 * step;
  const Ripples found = scanned(rippled({near, near + step, near + 20.0 * step}, 6.0));
  EXPECT_GE(found.cycles.size(), 2U);
  for (std::size_t a = 0; a < found.cycles.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT(std::abs(found.cycles[a] - found.cycles[b]), 1.5 * step);
}

TEST_F(RippleScan, OfNothingButNoiseIsOneWaveThatDoesNotPay) {
  for (int joint = 0; joint < arm.joints(); ++joint) {
    const Ripples found = scanned(rippled({}, 0.0), joint);
    EXPECT_EQ(found.cycles.size(), 1U) << joint;
    EXPECT_LT(found.strongest_ln_bayes, price()) << joint;
  }
}

TEST_F(RippleScan, CountsTheWavesThatItTried) {
  const WhitenedFit s = rippled({}, 0.0);
  int tried = 7;
  scan_ripples(Scorer(s), kJoint, kRegressors, tried);
  EXPECT_EQ(tried, 7 + static_cast<int>(ripple_grid(s, kJoint).size()));
  scan_fast_ripples(Scorer(s), kJoint, tried);
  EXPECT_EQ(tried, 7 + static_cast<int>(ripple_grid(s, kJoint).size() +
                                        fast_ripple_grid(s, kJoint).size()));
}

TEST_F(RippleScan, OfAJointThatNeverMovesIsNone) {
  Measurements still = *arm.measured;
  still.q.col(kJoint).setConstant(0.3);
  WhitenedFit s = rippled({}, 0.0);
  s.measured = &still;
  EXPECT_TRUE(scanned(s).cycles.empty());
  int tried = 0;
  EXPECT_TRUE(scan_fast_ripples(Scorer(s), kJoint, tried).cycles.empty());
  EXPECT_EQ(tried, 0);
}

TEST_F(RippleScan, FastWavesAreFoundBeyondTheUsualOnes) {
  for (const double wave : {61.3, 118.0, 173.4}) {
    const WhitenedFit s = rippled({wave}, 3.0);
    int tried = 0;
    const Ripples fast = scan_fast_ripples(Scorer(s), kJoint, tried);
    ASSERT_EQ(fast.cycles.size(), 1U);
    EXPECT_NEAR(fast.cycles.front(), wave, 0.06);
    EXPECT_GT(fast.strongest_ln_bayes, price());
    EXPECT_LT(scanned(s).strongest_ln_bayes, fast.strongest_ln_bayes);
  }
}

TEST_F(RippleScan, WithoutAFoldChoosesByTheOtherFoldsAlone) {
  const std::size_t own = 2;
  const WhitenedFit s = rippled({6.0, 13.0}, 1.0);
  Eigen::VectorXd lines = s.y;
  const Segment& fold = s.folds[own];
  const WhitenedFit other = rippled({22.0}, 20.0);
  lines.segment(3 * fold.begin, 3 * fold.size()) = other.y.segment(3 * fold.begin, 3 * fold.size());
  const WhitenedFit spoilt = leaving(arm, lines);
  const auto before = waves_without_folds(Scorer(s), kJoint, {6.0, 13.0}, kRegressors);
  const auto after = waves_without_folds(Scorer(spoilt), kJoint, {6.0, 13.0}, kRegressors);
  ASSERT_EQ(before.size(), s.folds.size());
  ASSERT_EQ(after.size(), s.folds.size());
  EXPECT_EQ(after[own], before[own]);
  EXPECT_TRUE(has(before[own], 13.0, 1e-9));
  int changed = 0;
  for (std::size_t f = 0; f < after.size(); ++f) changed += after[f] != before[f] ? 1 : 0;
  EXPECT_GT(changed, 0) << "the others see what has changed";
}

TEST_F(RippleScan, WithoutAFoldTakesTheRefinedWaveForThatOfTheGrid) {
  const double refined = scanned(rippled({9.37}, 3.0)).cycles.front();
  const WhitenedFit s = rippled({9.37}, 3.0);
  const Scorer scorer(s);
  for (const auto& waves : waves_without_folds(scorer, kJoint, {refined}, kRegressors))
    EXPECT_TRUE(has(waves, refined, 1e-12));
}

TEST_F(RippleScan, AChoiceWithoutWavesIsScoredAsNothing) {
  const WhitenedFit s = rippled({9.0}, 3.0);
  const Scorer scorer(s);
  const auto scored = scored_without_folds(scorer, kJoint, {{9.0}, {}});
  ASSERT_EQ(scored.size(), 2U);
  EXPECT_EQ(scored[1].theta.size(), 0);
  EXPECT_NEAR(scored[0].explained, scorer.score(ripple_regressor(s, kJoint, {9.0})).explained,
              1e-12);
}

}  // namespace
}  // namespace plumb::offline
