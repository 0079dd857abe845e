// SPDX-License-Identifier: Apache-2.0
// A slice of the blind study. The whole of it, and what it came to: docs/blind-study.md.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/blind/marks.hpp"
#include "tests/blind/study.hpp"

namespace plumb::tests {
namespace {

// Sanitizers slow a case down twenty times, and find nothing new in the next one.
constexpr int kCases = PLUMB_BLIND_CASES;
constexpr double kGranted = 3.0;  // standard errors: two dozen marks of a few dozen cases each

TEST(BlindSlice, PassesTheMarks) {
  const auto scores = run_study(7, kCases, [](int) {});
  const auto marks = marks_of(scores, kGranted);
  std::printf("%s", table_of(marks).c_str());
  for (const auto& mark : marks)
    EXPECT_TRUE(mark.passed) << mark.what << ": " << mark.value << ", asked for " << mark.pass;
  const auto made =
      std::count_if(scores.begin(), scores.end(), [](const auto& s) { return s.made; });
  EXPECT_GE(made, kCases * 98 / 100);
}

/// The last column of the table for 200 clean arms, of which `wrong` were said to lack something.
std::string result_of_false_findings(int wrong) {
  std::vector<Score> scores(200);
  for (int i = 0; i < 200; ++i) {
    Score& s = scores[i];
    s.drawn.group = Group::kNothing;
    s.made = true;
    s.finding = i < wrong ? offline::Finding::kMissing : offline::Finding::kComplete;
  }
  const std::string table = table_of(marks_of(scores, 2.0));
  const std::string row = "| nothing hidden, yet something named |";
  const std::string line =
      table.substr(table.find(row), table.find('\n', table.find(row)) - table.find(row));
  return line.substr(line.rfind("| ", line.size() - 3) + 2, std::string::npos);
}

// The mark is 1 %, and two standard errors of 200 cases are 1.4 %.
TEST(BlindTable, SaysMissedWhereAValueIsBeyondItsMark) {
  EXPECT_EQ(result_of_false_findings(2), "passed |");
  EXPECT_EQ(result_of_false_findings(3), "missed, within the allowance |");
  EXPECT_EQ(result_of_false_findings(4), "missed, within the allowance |");
  EXPECT_EQ(result_of_false_findings(5), "missed |");
}

/// A diagnoser that always says the same must not pass.
TEST(BlindSlice, AGuessThatIsAlwaysTheSameMissesTheMarks) {
  std::vector<Score> scores;
  for (int i = 0; i < 200; ++i) {
    Score s;
    s.drawn = draw_case(7, i);
    s.made = true;
    s.finding = s.finding_after = offline::Finding::kMissing;
    const auto& hidden = s.drawn.hidden;
    s.class_first = s.joint_first =
        !hidden.empty() && hidden.front().law == "joint_compliance" && hidden.front().joint == 1;
    s.recalled.assign(hidden.size(), s.class_first);
    s.added = 1;
    s.extra = s.class_first ? 0 : 1;
    s.before = s.after = 5.0;
    scores.push_back(std::move(s));
  }
  const auto marks = marks_of(scores, kGranted);
  const auto missed =
      std::count_if(marks.begin(), marks.end(), [](const auto& m) { return !m.passed; });
  EXPECT_GE(missed, 10) << table_of(marks);
}

}  // namespace
}  // namespace plumb::tests
