// SPDX-License-Identifier: Apache-2.0
// The generator of the study of measured orientations. The whole of the study: docs/blind-study.md.
#include <gtest/gtest.h>

#include <cmath>

#include "noise/orientation_floor.hpp"
#include "tests/blind/orientation_case.hpp"
#include "tests/blind/orientation_marks.hpp"
#include "tests/blind/seen.hpp"

namespace plumb::tests {
namespace {

TEST(OrientationCases, AreTheSameArmWithEachKindOfOrientations) {
  for (int arm = 0; arm < 40; ++arm) {
    const HiddenCase first = draw_orientation_case(3, 4 * arm);
    EXPECT_EQ(first.hidden.empty(), arm % 4 == 0);
    for (int kind = 0; kind < 4; ++kind) {
      const HiddenCase one = draw_orientation_case(3, 4 * arm + kind);
      EXPECT_EQ(one.kind, orientation_kinds()[static_cast<std::size_t>(kind)]);
      EXPECT_EQ(one.request.effects, first.request.effects);
      EXPECT_EQ(one.request.seed, first.request.seed);
      EXPECT_EQ(one.request.turns.has_value(), kind < 3);
    }
  }
}

TEST(OrientationCases, ReachTheDiagnosisAsWrittenAndScatterAsAsked) {
  const auto floor_of = [](int kind) {
    const HiddenCase drawn = draw_orientation_case(3, kind);
    const Seen seen = written_and_read(make_blind_case(drawn.request), drawn.request.seed);
    return offline::orientation_floor(seen.cell, seen.measured).sigma_rad /
           drawn.request.turns->sigma_rad;
  };
  EXPECT_NEAR(floor_of(0), 1.0, 0.5);
  EXPECT_NEAR(floor_of(1), 20.0, 10.0);
  EXPECT_NEAR(floor_of(2), 1.0, 0.5) << "repeats agree";
}

TEST(OrientationMarks, AGuessThatIsAlwaysTheSameMissesThem) {
  std::vector<Score> scores;
  for (int i = 0; i < 160; ++i) {
    Score s;
    s.finding = offline::Finding::kMissing;
    s.claims = Claims{.alarm = true};
    s.drawn = draw_orientation_case(7, i);
    s.made = true;
    s.before = 5.0;
    s.after = 6.0;
    scores.push_back(std::move(s));
  }
  for (const auto& mark : orientation_marks_of(scores, 3.0)) EXPECT_FALSE(mark.passed) << mark.what;
}

}  // namespace
}  // namespace plumb::tests
