// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/syscall.h>

#include <atomic>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "plumb/drivers/run_loop.hpp"
#include "tests/drivers/session_rig.hpp"
#include "tests/drivers/watched_calls.hpp"

namespace plumb::tests {

inline constexpr std::int64_t kBeat_ns = 1'000'000;

inline SessionSettings full_correction() {
  SessionSettings out;
  out.mode = CorrectionMode::kFull;
  out.cycle_s = 1e-9 * static_cast<double>(kBeat_ns);
  out.rearm_s = 0.05;
  return out;
}

/// SessionRig's controller on a thread of its own, beside the cycle that is watched.
class ControllerThread {
 public:
  ControllerThread(SessionRig& rig, BusPort& port)
      : thread_([this, &rig, &port] {
          while (!ended_) {
            beat(rig, port);
            std::ignore = MonotonicTime::sleep_until_ns(MonotonicTime::now_ns() + kBeat_ns);
          }
        }) {}
  ~ControllerThread() {
    ended_ = true;
    thread_.join();
  }

 private:
  static void beat(SessionRig& rig, BusPort& port) {
    for (const BusMessage& message : rig.controller_says()) port.send(message);
    for (BusMessage answer; port.receive(answer);) {
    }
    ++rig.counter;
    rig.swing();
  }

  std::atomic<bool> ended_{false};
  std::thread thread_;
};

/// What the watched thread of a linked loop may ask of the system, and how long it is watched.
struct Watched {
  std::vector<int> allowed;
  long cycles = 3000;
  long answers = 1000;
};

inline constexpr const char* kNoFilterHere = "no seccomp filter can be installed here";

inline void expect_clean(const WatchedCalls& calls, const Watched& how) {
  EXPECT_EQ(calls.heap, 0);
  EXPECT_EQ(calls.locks, 0);
  EXPECT_EQ(calls.system_call, -1);
  EXPECT_GE(calls.cycles, how.cycles);
  EXPECT_GE(calls.answered, how.answers);
}

/// The clock of a cycle. The kernel is asked for the time where it cannot be read without.
inline const std::vector<int> kClockCalls{SYS_clock_nanosleep, SYS_clock_gettime};

/// Runs the real loop in real time on `plumb`, against a controller on `controller`: first until it
/// corrects, then watched. A minute at most. False: this thread cannot be watched here.
inline bool run_linked_loop(BusPort& plumb, BusPort& controller, const Watched& how,
                            WatchedCalls& calls) {
  constexpr long kMostCycles = 60'000;
  SessionRig rig(full_correction());
  const auto shared = std::make_unique<RunShared>();
  const auto clock = std::make_unique<CycleClock<MonotonicTime>>(kBeat_ns);
  using Loop = RunLoop<MonotonicTime>;
  const auto loop =
      std::make_unique<Loop>(*rig.session, plumb, *shared, *clock, MonotonicTime{}, RunSettings{});
  const ControllerThread beside(rig, controller);
  const auto answered = [&] { return static_cast<long>(rig.session->report().counters.answered); };
  long cycle = 0;
  for (; cycle < kMostCycles && answered() == 0; ++cycle) loop->cycle();
  const long before = cycle, answers = answered();
  if (!watch_this_thread(calls, how.allowed)) return false;
  while (cycle < kMostCycles && (calls.cycles < how.cycles || calls.answered < how.answers)) {
    if (loop->cycle() != Loop::Next::kGoOn) break;
    calls.cycles = ++cycle - before;
    calls.answered = answered() - answers;
  }
  ::_exit(0);  // not even the end of a thread is allowed
}

}  // namespace plumb::tests
