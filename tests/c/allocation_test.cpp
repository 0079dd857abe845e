// SPDX-License-Identifier: Apache-2.0
// No allocation in a step of the cycle, nor in the calls of the C interface that belong to it.
#include "plumb/runtime/cycle.hpp"
#include "tests/c/support.hpp"
#include "tests/heap_calls.hpp"

namespace plumb::tests {
namespace {

TEST(Allocation, IsSeenWhenAModelIsSwapped) {
  const Robot robot;
  const Bytes file = file_of(informed_arm());
  EXPECT_GT(heap_calls_of([&] {
              EXPECT_EQ(plumb_swap_bytes(robot.get(), file.data(), file.size(), nullptr, 0),
                        PLUMB_OK);
            }),
            0);
}

TEST(Allocation, NeverHappensInTheCallsOfTheCycle) {
  const Robot robot;
  const Bytes file = file_of(informed_arm());
  plumb_output out = blank_output();
  plumb_joints joints{sizeof(plumb_joints), 0, {}};
  plumb_prediction prediction{};
  prediction.size = sizeof prediction;
  plumb_counters counters{};
  counters.size = sizeof counters;
  plumb_input in = sound_input();
  for (int swap = 0; swap < 20; ++swap) {
    ASSERT_EQ(plumb_swap_bytes(robot.get(), file.data(), file.size(), nullptr, 0), PLUMB_OK);
    ASSERT_EQ(heap_calls_of([&] {
                for (int k = 0; k < 500; ++k) {
                  in.now_ns += kTick_ns;
                  in.X_BD.p_m[1] += k % 50 == 0 ? NAN : 0.0;
                  if (k % 50 == 10) in = sound_input();
                  (void)plumb_correct(robot.get(), &in, &out);
                  (void)plumb_predict(robot.get(), &joints, &prediction);
                  (void)plumb_enable(robot.get(), k % 100 < 80 ? 1 : 0);
                  (void)plumb_read_counters(robot.get(), &counters);
                }
              }),
              0);
  }
  EXPECT_EQ(counters.steps, 10'000U);
  EXPECT_EQ(counters.swaps, 20U);
}

TEST(Allocation, NeverHappensForRows) {
  const Robot robot;
  const plumb_pose X_BD = sound_input().X_BD;
  plumb_rows rows{};
  rows.size = sizeof rows;
  rows.seed = PLUMB_MEASURED;
  rows.count = 1;
  rows.q = home();
  plumb_pose X{};
  double q[PLUMB_MAX_JOINTS];
  std::int32_t status = 0;
  EXPECT_EQ(heap_calls_of([&] {
              (void)plumb_predict_rows(robot.get(), &rows, &X, &status);
              (void)plumb_correct_rows(robot.get(), &rows, &X_BD, &X, q, &status);
            }),
            0);
  EXPECT_GE(status, 0);
}

TEST(Allocation, NeverHappensInAStepOfTheCycle) {
  const auto first = LoadedModel::make(informed_arm());
  const auto second = LoadedModel::make(informed_arm());
  ModelSlot slot(*first);
  Cycle cycle(slot);
  CycleInput in;
  in.target = in.joints = Arrival::kArrived;
  in.X_BD = first->corrector().nominal().forward(std::span(home(), 6));
  std::copy_n(home(), PLUMB_MAX_JOINTS, in.q_measured.begin());
  EXPECT_EQ(heap_calls_of([&] {
              for (int k = 0; k < 10'000; ++k) {
                in.now_ns += kTick_ns;
                (void)cycle.step(in);
                if (k % 100 == 50) (void)slot.publish(k % 200 == 50 ? *second : *first);
              }
            }),
            0);
  EXPECT_EQ(cycle.counters().swaps, 100U);
}

}  // namespace
}  // namespace plumb::tests
