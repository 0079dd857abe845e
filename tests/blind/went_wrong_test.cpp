// SPDX-License-Identifier: Apache-2.0
// Cases of the study of inconvenient arms in which a diagnosis once said something wrong with
// confidence, or made the arm worse. Found with seeds 5 and 6, which no published table uses, and
// one with seed 2029, as its page says; run one with: blind_study --inconvenient --case NUMBER 1
// SEED --list
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/blind/inconvenient_case.hpp"
#include "tests/blind/score.hpp"

namespace plumb::tests {
namespace {

struct Case {
  std::uint64_t seed;
  int number;
};

Score score_of(const Case& one) {
  const Score out = run_case(draw_inconvenient_case(one.seed, one.number));
  EXPECT_TRUE(out.made) << out.why_not;
  return out;
}

/// Moves of the base are hidden beside another effect. One of the moves that were found had been
/// dropped, which kept the others out of the comparison with a drift: it took their place, and the
/// error rose from the noise to twice it and more.
TEST(WentWrong, MovesThatWereFoundAreNotLostToADrift) {
  for (const Case& one : {Case{5, 108}, Case{5, 350}, Case{5, 438}}) {
    const Score score = score_of(one);
    EXPECT_LT(score.after, 0.2 * score.before) << one.number << ": " << score.said;
    EXPECT_EQ(score.claims->unrelated, 0) << one.number << ": " << score.said;
  }
}

/// An encoder moves with the temperature, which no law of the library describes. A step of encoder
/// or base stayed in the model, and doubled the error of new poses.
TEST(WentWrong, AStepThatImitatesATemperatureIsNotKept) {
  for (const Case& one : {Case{5, 161}, Case{5, 436}, Case{5, 655}, Case{6, 485}}) {
    const Score score = score_of(one);
    EXPECT_LT(score.after, 1.02 * score.before) << one.number << ": " << score.said;
    EXPECT_TRUE(score.unknown_said && score.inputs_right) << one.number << ": " << score.said;
  }
}

/// Ten waves fit 45 poses well if their frequencies may be chosen by all of them.
TEST(WentWrong, WavesOfFewPosesAreChosenWithoutThePosesThatJudgeThem) {
  for (const Case& one : {Case{6, 573}, Case{6, 755}}) {
    const Score score = score_of(one);
    EXPECT_LT(score.after, 1.02 * score.before) << one.number << ": " << score.said;
  }
}

/// A link bends, or the base tilts; no mass is stated. A yielding joint was named with certainty.
TEST(WentWrong, WithoutMassesAYieldingJointIsOneOfSeveral) {
  for (const Case& one : {Case{5, 37}, Case{5, 257}, Case{5, 312}, Case{5, 345}, Case{5, 455}}) {
    const Score score = score_of(one);
    EXPECT_TRUE(score.claims->first_right || score.claims->either_right)
        << one.number << ": " << score.said;
  }
}

/// What a second effect leaves at a joint looks like the scatter of that joint. The promised fall
/// was that of the error divided by the scatter.
TEST(WentWrong, ThePromisedFallIsThatOfTheErrorItself) {
  for (const Case& one : {Case{5, 426}, Case{5, 602}}) {
    const Score score = score_of(one);
    if (!score.claims->fall_counts) continue;
    EXPECT_NEAR(score.claims->fall, score.claims->true_fall,
                std::max(0.05, 3.0 * score.claims->fall_se))
        << one.number << ": " << score.said;
  }
}

/// Nothing is hidden but the scatter of the joints. Where no single effect had been found, nobody
/// asked what the scatter explains, and a series of waves at four joints made the arm worse.
TEST(WentWrong, TheScatterOfJointsIsNoSeriesOfThem) {
  const Score score = score_of({2029, 23});
  EXPECT_FALSE(score.after > score.before) << score.said;
  EXPECT_EQ(score.claims->unrelated, 0) << score.said;
}

}  // namespace
}  // namespace plumb::tests
