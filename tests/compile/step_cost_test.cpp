// SPDX-License-Identifier: Apache-2.0
#include "bench/step_cost.hpp"

#include <gtest/gtest.h>

#include "bench/machine.hpp"
#include "bench/step_instructions.hpp"
#include "tests/rt/cycle_model.hpp"

namespace plumb::offline::bench {
namespace {

TEST(StepCost, IsThatOfAWholeStepOnThisMachine) {
  const StepCost cost = step_cost(tests::one_arm());
  EXPECT_GT(cost.median_us, 0.1);
  EXPECT_GE(cost.worst_us, cost.median_us);
  EXPECT_FALSE(cost.build.empty());
  EXPECT_EQ(cost.instructions, step_instructions(tests::one_arm()));
  EXPECT_EQ(cost.why_not_representative, why_not_representative(look_at_machine(), this_build()));
}

/// Counted by callgrind in the preset release: an arm of six joints that was calibrated and nothing
/// more, and one of which gravity bends two joints.
TEST(StepCost, ForeseesTheInstructionsOfTheBuildForEveryProcessor) {
  auto arm = tests::one_arm();
  EXPECT_NEAR(baseline_instructions(arm) / step_instructions(arm), 1.76, 0.03);
  auto more = tests::cycle_model();
  EXPECT_GT(baseline_instructions(more), 1.3 * step_instructions(more));
  EXPECT_LT(baseline_instructions(more), 2.0 * step_instructions(more));
}

/// 16,700 are counted by callgrind (docs/real-time.md); tests/rt/count_steps checks many more.
TEST(StepCost, ForeseesTheInstructionsOfTheBudgetsModel) {
  EXPECT_NEAR(step_instructions(tests::cycle_model()), 16'700.0, 0.15 * 16'700.0);
  auto more = tests::cycle_model();
  more.effects.push_back(more.effects[1]);
  EXPECT_GT(step_instructions(more), step_instructions(tests::cycle_model()) + 100.0);
}

TEST(StepCost, AStepThatTakesMoreThanHalfOfTheCycleDoesNotFit) {
  StepCost cost;
  cost.cpu = "a slow processor";
  cost.worst_us = 49.0;
  EXPECT_EQ(cycle_fault(cost, 100e-6), "");
  cost.worst_us = 51.0;
  const std::string fault = cycle_fault(cost, 100e-6);
  EXPECT_NE(fault.find("51 us on a slow processor"), std::string::npos) << fault;
  EXPECT_NE(fault.find("cycle of 100 us"), std::string::npos) << fault;
  EXPECT_EQ(cycle_fault(cost, 1e-3), "");
  cost.optimised = false;  // the times of such a build mean nothing
  EXPECT_EQ(cycle_fault(cost, 100e-6), "");
}

}  // namespace
}  // namespace plumb::offline::bench
