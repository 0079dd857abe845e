// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "program/counted_words.hpp"
#include "show/plan_view.hpp"

namespace plumb::offline {
namespace {

PlanRequest of_two() {
  PlanRequest out;
  out.separate = {{.name = "joint_compliance", .joints = {1}, .options = {}, .place = {}},
                  {.name = "gear_harmonics", .joints = {1}, .options = {}, .place = {}}};
  return out;
}

std::string said(const PosePlan& plan) { return text_of(show::plan_blocks(of_two(), plan)); }

TEST(PlanWords, PromiseNothingWhereThePosesMeasuredDecideAlready) {
  PosePlan plan;
  plan.measured = 240;
  plan.poses.resize(40);
  for (const double today : {-300.0, -149.0, -10.0, -9.0, 0.0, 9.0, 10.0, 149.0}) {
    plan.expected = {.today = today, .if_a = 715.0, .if_b = 720.0};
    const bool decided = std::abs(today) >= 10.0;
    EXPECT_EQ(said(plan).starts_with("Decided already: "), decided) << said(plan);
    EXPECT_EQ(said(plan).find("are expected to decide") == std::string::npos, decided);
  }
  plan.expected.today = -149.0;
  EXPECT_NE(said(plan).find("gear_harmonics is ahead of joint_compliance by 149 nats at the 240 "
                            "poses measured"),
            std::string::npos)
      << said(plan);
  plan.expected.today = {};
  EXPECT_NE(said(plan).find("are expected to decide"), std::string::npos) << "nothing is measured";
}

TEST(PlanWords, OneIsSingular) {
  PosePlan plan;
  plan.poses.resize(1);
  for (const double lead : {1.0, 100.0}) {
    plan.expected = {.today = {}, .if_a = lead, .if_b = lead};
    EXPECT_NE(said(plan).find("Planned 1 reading to tell"), std::string::npos) << said(plan);
    EXPECT_NE(said(plan).find("This reading "), std::string::npos) << said(plan);
  }
  EXPECT_EQ(counted_words(0, "pose", "poses"), "0 poses");
  EXPECT_EQ(counted_words(1, "pose", "poses"), "1 pose");
  EXPECT_EQ(counted_words(-1, "row", "rows"), "-1 rows");
}

}  // namespace
}  // namespace plumb::offline
