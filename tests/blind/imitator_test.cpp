// SPDX-License-Identifier: Apache-2.0
// The generator of the study of imitators, and what its table counts. The whole of the study:
// docs/blind-study.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/blind/imitator_case.hpp"
#include "tests/blind/imitator_marks.hpp"

namespace plumb::tests {
namespace {

using offline::Finding;

TEST(ImitatorCases, AreBalancedOverKindsAndAlwaysTheSame) {
  const auto kinds = imitator_kinds().size();
  std::set<int> poses;
  for (int i = 0; i < 140; ++i) {
    const HiddenCase one = draw_imitator_case(3, i), two = draw_imitator_case(3, i);
    EXPECT_EQ(one.kind, imitator_kinds()[static_cast<std::size_t>(i) % kinds]);
    EXPECT_EQ(one.request.effects, two.request.effects);
    EXPECT_EQ(one.request.seed, two.request.seed);
    EXPECT_EQ(one.hidden.size(), 1U);
    poses.insert(one.request.poses);
  }
  EXPECT_EQ(poses, (std::set<int>{45, 150, 500}));
}

TEST(ImitatorCases, TheFirstPartOfTheStudyDrawsNoneOfTheirLaws) {
  std::set<std::string> laws;
  for (std::size_t i = 0; i < imitator_kinds().size(); ++i)
    laws.insert(draw_imitator_case(3, static_cast<int>(i)).hidden.front().law);
  EXPECT_EQ(laws.size(), imitator_kinds().size());
  for (const Group group : {Group::kOne, Group::kUnknown, Group::kThree})
    for (const auto* law : laws_of(group)) EXPECT_FALSE(laws.contains(law->name)) << law->name;
}

/// A record without temperatures, in which the visible part of the growth is as large as asked.
TEST(ImitatorCases, GrowthWithoutASensorRecordsNoTemperature) {
  const auto at =
      std::find(imitator_kinds().begin(), imitator_kinds().end(), "growth without a sensor") -
      imitator_kinds().begin();
  const HiddenCase drawn = draw_imitator_case(7, static_cast<int>(at));
  const auto blind = make_blind_case(drawn.request);
  EXPECT_EQ(blind.measurements_csv.find("temp"), std::string::npos);
  EXPECT_NEAR(blind.measured.sizes.front().visible_m,
              drawn.hidden.front().sigmas * drawn.request.sigma_m, 0.01 * drawn.request.sigma_m);
}

Score imitator_score(Finding finding, Claims claims) {
  Score out;
  out.finding = finding;
  out.claims = claims;
  return out;
}

TEST(ImitatorOutcome, ACauseForCertainIsRightOrWrong) {
  EXPECT_EQ(outcome_of(imitator_score(Finding::kMissing, {.first_right = true})), Outcome::kRight);
  EXPECT_EQ(outcome_of(imitator_score(Finding::kMissing, {})), Outcome::kWrong);
}

TEST(ImitatorOutcome, OneOfSeveralIsRightIfTheTruthIsAmongThem) {
  EXPECT_EQ(
      outcome_of(imitator_score(Finding::kUndecidable, {.either = true, .either_right = true})),
      Outcome::kRight);
  EXPECT_EQ(outcome_of(imitator_score(Finding::kUndecidable, {.either = true})), Outcome::kWrong);
}

TEST(ImitatorOutcome, CannotTellIsVague) {
  EXPECT_EQ(outcome_of(imitator_score(Finding::kUndecidable, {})), Outcome::kVague);
  EXPECT_EQ(outcome_of(imitator_score(Finding::kComplete, {})), Outcome::kVague);
  EXPECT_EQ(outcome_of(imitator_score(Finding::kUnknown, {})), Outcome::kVague);
  EXPECT_EQ(
      outcome_of(imitator_score(Finding::kUndecidable, {.either = true, .slow_motion = true})),
      Outcome::kVague);
}

TEST(ImitatorOutcome, UnknownIsRightWithTheInputsOfTheTruth) {
  Score score = imitator_score(Finding::kUnknown, {});
  score.unknown_said = score.inputs_right = true;
  EXPECT_EQ(outcome_of(score), Outcome::kRight);
}

TEST(ImitatorOutcome, AnotherGravityForCertainIsWrong) {
  EXPECT_EQ(outcome_of(imitator_score(Finding::kUndecidable, {.turned_gravity = true})),
            Outcome::kWrong);
}

TEST(ImitatorOutcome, WhatIsSaidToBeAPartOfAnotherCauseIsNotNamedForCertain) {
  EXPECT_EQ(outcome_of(imitator_score(Finding::kMissing, {.first_doubtful = true, .unrelated = 1})),
            Outcome::kVague);
}

TEST(ImitatorOutcome, AnAdditionOfAnotherCauseIsWrongWhateverElseIsSaid) {
  EXPECT_EQ(
      outcome_of(imitator_score(Finding::kMissing, {.first_right = true, .unrelated_certain = 1})),
      Outcome::kWrong);
}

/// A diagnoser that always names the same for certain must miss every mark.
TEST(ImitatorMarks, AGuessThatIsAlwaysTheSameMissesThem) {
  std::vector<Score> scores;
  for (int i = 0; i < 140; ++i) {
    Score s = imitator_score(Finding::kMissing, {.alarm = true});
    s.drawn = draw_imitator_case(7, i);
    s.made = true;
    s.before = 5.0;
    s.after = 6.0;
    scores.push_back(std::move(s));
  }
  for (const auto& mark : imitator_marks_of(scores, 3.0)) EXPECT_FALSE(mark.passed) << mark.what;
}

}  // namespace
}  // namespace plumb::tests
