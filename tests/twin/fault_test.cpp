// SPDX-License-Identifier: Apache-2.0
#include "twin/fault.hpp"

#include <gtest/gtest.h>

#include "program/problem.hpp"
#include "twin/faulty_line.hpp"

namespace plumb::offline::twin {
namespace {

TEST(Fault, IsReadWithSizeStartAndLength) {
  const Fault lose = parse_fault("lose=30%@5+10");
  EXPECT_EQ(lose.kind, FaultKind::kLose);
  EXPECT_DOUBLE_EQ(lose.size, 0.3);
  EXPECT_FALSE(lose.always);
  EXPECT_DOUBLE_EQ(lose.from_s, 5.0);
  EXPECT_DOUBLE_EQ(lose.for_s, 10.0);
  EXPECT_DOUBLE_EQ(parse_fault("late=20ms").size, 0.02);
  EXPECT_TRUE(parse_fault("absolute").always);
  EXPECT_TRUE(std::isinf(parse_fault("stop@3").for_s));
}

TEST(Fault, WhatIsNoFaultIsRefusedWithHelp) {
  for (const char* text : {"", "loose=30%", "lose", "lose=30", "lose=130%", "late=x", "stop=3",
                           "late=20min", "stop@x", "stop@1+", "lose=-1%", "lose=nan%"}) {
    SCOPED_TRACE(text);
    try {
      parse_fault(text);
      ADD_FAILURE() << "was taken";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), Exit::kUsage);
      EXPECT_EQ(failure.problems().front().code, "E-TWIN-FAULT");
      EXPECT_FALSE(failure.problems().front().help.empty());
    }
  }
}

TEST(Fault, HoldsInItsTimeOnly) {
  const FaultPlan plan({parse_fault("stop@3+1"), parse_fault("manual")});
  EXPECT_FALSE(plan.active(FaultKind::kStop, -1.0));
  EXPECT_FALSE(plan.active(FaultKind::kStop, 2.999));
  EXPECT_TRUE(plan.active(FaultKind::kStop, 3.0));
  EXPECT_FALSE(plan.active(FaultKind::kStop, 4.0));
  EXPECT_TRUE(plan.active(FaultKind::kManual, -1.0));
  EXPECT_FALSE(plan.active(FaultKind::kTool, 0.0));
}

/// Units 0 .. n - 1, one a millisecond, and when each came out.
std::vector<std::pair<int, std::int64_t>> carried(const std::string& fault, int n) {
  const FaultPlan plan({parse_fault(fault)});
  FaultyLine<int> line(plan, 1, "line", [](int& unit, sim::Random&) {
    unit = -unit;
    return true;
  });
  std::vector<std::pair<int, std::int64_t>> out;
  for (int k = 0; k < n + 1000; ++k) {
    const std::int64_t now_ns = 1'000'000LL * k;
    if (k < n) line.put(k, now_ns, 1.0);
    for (int unit = 0; line.get(unit, now_ns);) out.emplace_back(unit, now_ns);
  }
  return out;
}

TEST(FaultyLine, LosesRepeatsCorruptsAndDelaysAsMuchAsItIsTold) {
  constexpr int kMany = 10000;
  EXPECT_NEAR(static_cast<double>(carried("lose=30%", kMany).size()), 0.7 * kMany, 0.02 * kMany);
  EXPECT_NEAR(static_cast<double>(carried("repeat=30%", kMany).size()), 1.3 * kMany, 0.02 * kMany);
  int corrupt = 0;
  for (const auto& [unit, when] : carried("corrupt=10%", kMany)) corrupt += unit < 0 ? 1 : 0;
  EXPECT_NEAR(corrupt, 0.1 * kMany, 0.02 * kMany);
  for (const auto& [unit, when] : carried("late=20ms", 100))
    EXPECT_EQ(when, 1'000'000LL * (unit + 20));
  EXPECT_TRUE(carried("disconnect", 100).empty());
}

TEST(FaultyLine, ReorderedUnitsAllArrive) {
  auto out = carried("reorder=20%", 1000);
  ASSERT_EQ(out.size(), 1000U);
  int overtaken = 0;
  for (std::size_t k = 1; k < out.size(); ++k) overtaken += out[k].first < out[k - 1].first ? 1 : 0;
  EXPECT_GT(overtaken, 50);
  std::sort(out.begin(), out.end());
  for (std::size_t k = 0; k < out.size(); ++k) EXPECT_EQ(out[k].first, static_cast<int>(k));
}

}  // namespace
}  // namespace plumb::offline::twin
