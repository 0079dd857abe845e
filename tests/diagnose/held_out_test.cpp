// SPDX-License-Identifier: Apache-2.0
// What is promised of poses that were not fitted.
#include "diagnose/held_out.hpp"

#include <gtest/gtest.h>

#include "noise/usual_errors.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

struct HeldOut : testing::Test {
  const WhitenedFit& arm = whitened_arm().whitened;
  Regressor gear = library_regressor(arm, entry_of("gear_harmonics", {1}));
  Eigen::VectorXd noise = noise_of(arm, 11);

  static CandidateInFolds in_folds(const WhitenedFit& s, const Regressor& regressor,
                                   const RegressorScore& scored) {
    return {{s.folds.size(), regressor}, {s.folds.size(), scored}};
  }
  /// The same fit without held-out poses.
  static WhitenedFit all_in_folds(WhitenedFit s) {
    s.held.end = s.held.begin;
    return s;
  }
};

TEST_F(HeldOut, WithoutACandidateIsWhatTheModelLeavesAtThePosesItNeverSaw) {
  const WhitenedFit s = leaving(arm, noise);
  std::vector<double> norms;
  for (Eigen::Index i = s.held.begin; i < s.held.end; ++i) {
    Eigen::VectorXd lines = s.y.segment(s.table.begin(i), s.table.count(i));
    unwhiten(s, i, lines);
    norms.push_back(lines.norm());
  }
  const ErrorStats expected = usual_errors(norms, s.table.most(), s.sigma_m);
  const ErrorStats found = held_out_error(Scorer(s)).points;
  EXPECT_EQ(found.n, expected.n);
  EXPECT_NEAR(found.rms, expected.rms, 1e-12 * expected.rms);
}

TEST_F(HeldOut, OfNothingButNoiseIsNeverImprovedMuch) {
  const WhitenedFit s = leaving(arm, noise);
  const Scorer scorer(s);
  const RegressorScore scored = scorer.score(gear);
  const CandidateInFolds candidate = in_folds(s, gear, scored);
  EXPECT_LT(held_out_gain(scorer, candidate).share, 0.05);
  EXPECT_FALSE(held_out_gain(scorer, candidate).clear);
  EXPECT_GT(held_out_error(scorer, gear, scored, candidate).points.rms,
            0.9 * held_out_error(scorer).points.rms);
}

TEST_F(HeldOut, OfAnEffectThatIsThereFallsToTheNoise) {
  for (const bool held : {true, false}) {
    const WhitenedFit whole = leaving(arm, noise + motion_of_size(arm, gear, 5.0));
    const WhitenedFit s = held ? whole : all_in_folds(whole);
    const Scorer scorer(s);
    const RegressorScore scored = scorer.score(gear);
    const CandidateInFolds candidate = in_folds(s, gear, scored);
    const double before = held_out_error(scorer).points.rms;
    const double after = held_out_error(scorer, gear, scored, candidate).points.rms;
    EXPECT_LT(after, 0.4 * before);
    EXPECT_GT(after, 0.9 * std::sqrt(3.0) * s.sigma_m) << "no less than the noise is left";
    EXPECT_TRUE(held_out_gain(scorer, candidate).clear);
  }
}

/// All readings are alike, so that lengths are whitened lines times one number.
TEST_F(HeldOut, TheFallInLengthsIsThatInWhitenedLinesWhereAllReadingsAreAlike) {
  const WhitenedFit s = leaving(arm, noise + motion_of_size(arm, gear, 2.0));
  const Scorer scorer(s);
  const RegressorScore scored = scorer.score(gear);
  const Gain lengths = held_out_gain(scorer, in_folds(s, gear, scored));
  EXPECT_NEAR(lengths.share, scorer.gain(scored).share, 1e-9);
  EXPECT_NEAR(lengths.share_se, scorer.gain(scored).share_se, 1e-9);
}

TEST_F(HeldOut, ACandidateWithoutColumnsAddsNothing) {
  const WhitenedFit s = all_in_folds(leaving(arm, noise));
  const Scorer scorer(s);
  const CandidateInFolds none = in_folds(s, {}, {});
  EXPECT_EQ(held_out_gain(scorer, none).share, 0.0);
  EXPECT_EQ(held_out_error(scorer, {}, {}, none).points.rms, held_out_error(scorer).points.rms);
}

TEST_F(HeldOut, WhatTheModelCanDoItselfChangesNothing) {
  const WhitenedFit s = leaving(arm, noise);
  const Scorer scorer(s);
  Regressor known;
  known.columns = s.U.leftCols(2);
  known.typical = Eigen::Vector2d::Ones();
  known.members = {0, 1};
  RegressorScore scored;
  scored.theta = Eigen::Vector2d(3.0, -40.0);
  EXPECT_NEAR(held_out_error(scorer, known, scored, {}).points.rms,
              held_out_error(scorer).points.rms, 1e-6 * held_out_error(scorer).points.rms);
}

TEST_F(HeldOut, ReadingsThatContradictTheOthersCountAsPosesThatWereNotFitted) {
  WhitenedFit s = all_in_folds(leaving(arm, noise));
  const ErrorStats without = held_out_error(Scorer(s)).points;
  s.contradicted_m = {1.5 * s.sigma_m, 2.5 * s.sigma_m};  // as the others: none is left out
  EXPECT_EQ(held_out_error(Scorer(s)).points.n, without.n + 2);
}

TEST_F(HeldOut, TwiceTheErrorInTwiceTheNoiseIsTheSameGain) {
  const Eigen::VectorXd lines = noise + motion_of_size(arm, gear, 1.0);
  const WhitenedFit one = leaving(arm, lines);
  WhitenedFit two = leaving(arm, 2.0 * lines);
  two.noise.variance *= 4.0;
  const auto of = [&](const WhitenedFit& s) {
    const Scorer scorer(s);
    // Sizes and prior scale with the lines.
    Regressor regressor = gear;
    if (&s == &two) regressor.columns *= 2.0;
    const RegressorScore scored = scorer.score(regressor);
    const CandidateInFolds candidate = in_folds(s, regressor, scored);
    return std::pair{held_out_gain(scorer, candidate).share,
                     held_out_error(scorer, regressor, scored, candidate).points.rms};
  };
  EXPECT_NEAR(of(two).first, of(one).first, 1e-9);
  EXPECT_NEAR(of(two).second, 2.0 * of(one).second, 1e-9 * of(one).second);
}

}  // namespace
}  // namespace plumb::offline
