// SPDX-License-Identifier: Apache-2.0
// Models of one robot swapped under a running cycle; no step beyond the slew limit, and another
// robot's model is kept out: 06_hot_swap robot.plumb better.plumb another_robot.plumb
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <thread>

#include "examples/model_file.hpp"
#include "plumb/runtime/cycle.hpp"

int main(int count, char** arguments) {
  if (count != 4) {
    std::fprintf(stderr, "usage: 06_hot_swap robot.plumb better.plumb another_robot.plumb\n");
    return 2;
  }
  auto running = load_or_exit(arguments[1]);
  plumb::ModelSlot slot(*running);
  plumb::Cycle cycle(slot);
  const double slew_m = running->limits().slew_m_per_s * running->limits().cycle_s;
  const std::array<double, 2> q{0.3, 0.8};
  const plumb::Transformd X_BD = running->corrector().nominal().forward(q);

  std::atomic<bool> stop{false};
  double largest_step_m = 0.0;
  std::thread cycle_thread([&] {
    plumb::CycleInput input{.target = plumb::Arrival::kArrived, .X_BD = X_BD};
    input.joints = plumb::Arrival::kArrived;
    std::copy(q.begin(), q.end(), input.q_measured.begin());
    plumb::Vector3 before = plumb::Vector3::Zero();
    while (!stop) {
      input.now_ns += 4'000'000;
      const plumb::Vector3 added = cycle.step(input).output.X_BC.p - X_BD.p;
      largest_step_m = std::max(largest_step_m, (added - before).norm());
      before = added;
    }
  });

  // The loader, this thread: load, publish, wait for the cycle's word, free.
  int refused = 0;
  for (int k = 0; k < 300; ++k) {
    auto next = load_or_exit(arguments[1 + (k + 1) % 3]);
    if (slot.publish(*next) == plumb::ModelSlot::Published::kOtherRobot) {
      ++refused;
      continue;
    }
    while (!slot.settled()) std::this_thread::yield();
    running = std::move(next);
  }
  stop = true;
  cycle_thread.join();
  std::printf("%llu swaps, %d models of another robot refused, largest step %.4f mm of %.4f\n",
              static_cast<unsigned long long>(cycle.counters().swaps), refused,
              1e3 * largest_step_m, 1e3 * slew_m);
  return largest_step_m <= slew_m + 1e-12 ? 0 : 1;
}
