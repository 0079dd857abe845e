// SPDX-License-Identifier: Apache-2.0
// Models swapped through the C interface while the cycle runs: swap_test [<swaps>]
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/c/support.hpp"

namespace plumb::tests {
namespace {

int swaps = 10'000;

Bytes calibrated(double by) {
  format::Model model = informed_arm();
  model.calibrated.joints[1].a += by;
  return file_of(model);
}

/// One cycle, watched.
void step(plumb_robot* robot, plumb_input& in, Laws& laws) {
  plumb_output out = blank_output();
  in.now_ns += kTick_ns;
  ASSERT_EQ(plumb_correct(robot, &in, &out), PLUMB_OK);
  ASSERT_GE(out.status, 0);
  laws.hold(out, in.X_BD);
}

/// Cycles until told to stop, also after a failure: the loader waits for it.
void cycle(plumb_robot* robot, const std::atomic<bool>& stop, long& cycles) {
  Laws laws;
  plumb_input in = sound_input();
  for (; !stop.load(std::memory_order_relaxed); ++cycles) step(robot, in, laws);
}

TEST(CSwap, AtFullSpeedNeverTearsNorSteps) {
  const Robot robot;
  const Bytes files[] = {calibrated(5e-4), calibrated(-5e-4)};
  format::Model other = informed_arm();
  other.serial = "C-2";
  const Bytes foreign = file_of(other);
  std::atomic<bool> stop{false};
  long cycles = 0, busy = 0;
  std::thread cycling([&] { cycle(robot.get(), stop, cycles); });
  const auto swap = [&robot](const Bytes& file) {
    return plumb_swap_bytes(robot.get(), file.data(), file.size(), nullptr, 0);
  };
  for (int k = 0; k < swaps; ++k) {
    plumb_result result = PLUMB_BUSY;
    while ((result = swap(k % 100 == 99 ? foreign : files[k % 2])) == PLUMB_BUSY) {
      ++busy;
      std::this_thread::yield();
    }
    ASSERT_EQ(result, k % 100 == 99 ? PLUMB_OTHER_ROBOT : PLUMB_OK);
  }
  stop = true;
  cycling.join();
  plumb_counters counters{};
  counters.size = sizeof counters;
  ASSERT_EQ(plumb_read_counters(robot.get(), &counters), PLUMB_OK);
  std::printf("%d swaps, %ld cycles, %ld times busy\n", swaps, cycles, busy);
  EXPECT_GE(counters.swaps, static_cast<std::uint64_t>(swaps - swaps / 100 - 1));
  EXPECT_EQ(counters.steps, static_cast<std::uint64_t>(cycles));
}

TEST(CSwap, DuringARampNeverSteps) {
  const Bytes other = calibrated(-1e-3);
  for (int phase = 0; phase < 100; phase += 3) {
    const Robot robot;
    Laws laws;
    plumb_input in = sound_input();
    plumb_output out = blank_output();
    for (int k = 0; k < 300; ++k) {
      if (k == phase) {
        ASSERT_EQ(plumb_swap_bytes(robot.get(), other.data(), other.size(), nullptr, 0), PLUMB_OK);
      }
      in.now_ns += kTick_ns;
      ASSERT_EQ(plumb_correct(robot.get(), &in, &out), PLUMB_OK);
      laws.hold(out, in.X_BD);
    }
    EXPECT_EQ(out.status, PLUMB_STATUS_CONTEXT_FALLBACK);
  }
}

}  // namespace
}  // namespace plumb::tests

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) plumb::tests::swaps = std::atoi(argv[1]);
  return RUN_ALL_TESTS();
}
