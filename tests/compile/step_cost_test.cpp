// SPDX-License-Identifier: Apache-2.0
#include "bench/step_cost.hpp"

#include <gtest/gtest.h>

#include "tests/rt/one_arm.hpp"

namespace plumb::offline::bench {
namespace {

TEST(StepCost, IsThatOfAWholeStepOnThisMachine) {
  const StepCost cost = step_cost(tests::one_arm());
  EXPECT_GT(cost.median_us, 0.1);
  EXPECT_GE(cost.p99_us, cost.median_us);
  EXPECT_FALSE(cost.build.empty());
  if (cost.instructions && cost.optimised) {
    EXPECT_GT(*cost.instructions, 1'000.0);
    EXPECT_LT(*cost.instructions, 100'000.0);
  }
}

TEST(StepCost, AStepThatTakesHalfOfTheCycleDoesNotFit) {
  StepCost cost;
  cost.median_us = 49.0;
  EXPECT_EQ(cycle_fault(cost, 100e-6), "");
  cost.median_us = 51.0;
  const std::string fault = cycle_fault(cost, 100e-6);
  EXPECT_NE(fault.find("51 us"), std::string::npos) << fault;
  EXPECT_NE(fault.find("cycle of 100 us"), std::string::npos) << fault;
  EXPECT_EQ(cycle_fault(cost, 1e-3), "");
  cost.optimised = false;  // the times of such a build mean nothing
  EXPECT_EQ(cycle_fault(cost, 100e-6), "");
}

}  // namespace
}  // namespace plumb::offline::bench
