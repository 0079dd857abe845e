// SPDX-License-Identifier: Apache-2.0
// A slice of the study of formulas. The whole of it, and what it came to: docs/formula-study.md.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/blind/formula_case.hpp"
#include "tests/blind/formula_marks.hpp"
#include "tests/blind/study.hpp"

namespace plumb::tests {
namespace {

constexpr int kSlice = 16;
constexpr std::uint64_t kSeed = 7;
constexpr double kGrantedToFew = 3.0;  // standard errors

TEST(FormulaSlice, PassesTheMarks) {
  const auto draw = [](int number) { return draw_formula_case(kSeed, number); };
  const auto scores = run_study(draw, kSlice, [](int) {});
  const auto marks = formula_marks_of(scores, kGrantedToFew);
  std::printf("%s", table_of(marks).c_str());
  for (const auto& mark : marks)
    EXPECT_TRUE(mark.passed) << mark.what << ": " << mark.value << ", asked for " << mark.pass;
  EXPECT_TRUE(std::any_of(scores.begin(), scores.end(),
                          [](const Score& s) { return s.formula && s.formula->offered > 0; }));
}

/// Scores of arms that hide nothing, of which one is offered a formula.
TEST(FormulaTable, MissesTheMarkWithOneFormulaForAnArmThatHidesNothing) {
  std::vector<Score> scores(100);
  for (auto& s : scores) {
    s.made = true;
    s.drawn.group = Group::kNothing;
    s.formula.emplace();
  }
  EXPECT_TRUE(formula_marks_of(scores, kGrantedToFew).front().passed);
  scores.front().formula->offered = 1;
  EXPECT_FALSE(formula_marks_of(scores, kGrantedToFew).front().passed);
}

}  // namespace
}  // namespace plumb::tests
