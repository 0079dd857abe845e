// SPDX-License-Identifier: Apache-2.0
// No allocation in a tick: every heap call of this program is counted.
#include <gtest/gtest.h>

#include <memory>

#include "plumb/drivers/cycle_clock.hpp"
#include "tests/drivers/scripted_time.hpp"
#include "tests/heap_calls.hpp"

namespace plumb::drivers {
namespace {

using tests::heap_calls_of;

TEST(ClockAllocation, IsCaughtWhenPlanted) {
  EXPECT_EQ(2, heap_calls_of([] {
              const auto planted = std::make_unique<double>(1.0);
              EXPECT_EQ(*planted, 1.0);
            }));
  EXPECT_EQ(2, heap_calls_of([] {
              void* volatile planted = std::malloc(8);
              std::free(planted);
            }));
}

TEST(ClockAllocation, NeverHappensInATickOfTheRealClock) {
  CycleClock<> clock(100'000);
  EXPECT_EQ(0, heap_calls_of([&] {
              for (int i = 0; i < 100; ++i) std::ignore = clock.wait();
            }));
  EXPECT_EQ(clock.counters().ticks, 100U);
}

TEST(ClockAllocation, NeverHappensWhenTicksAreMissed) {
  tests::Script script;
  CycleClock<tests::ScriptedTime> clock(1'000'000, {&script});
  EXPECT_EQ(0, heap_calls_of([&] {
              for (int i = 0; i < 1000; ++i) {
                script.now_ns += 2'500'000;
                std::ignore = clock.wait();
              }
            }));
  EXPECT_GT(clock.counters().missed, 1000U);
}

}  // namespace
}  // namespace plumb::drivers
