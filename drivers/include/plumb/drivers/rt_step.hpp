// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "plumb/drivers/finding.hpp"

namespace plumb::drivers {

/// The steps that make a process a real-time one, in the order in which they are taken.
enum class RtStepKind : std::uint8_t {
  kHeapKept,      // mallopt: freed memory stays in the process, and none comes from mmap
  kHeapTouched,   // the heap that start-up and loading may use is there before the cycle
  kStackTouched,  // and so is the stack of the calling thread
  kMemoryLocked,  // mlockall: nothing is paged out, now or later. After the heap: a limit too small
                  // for it must deny this step, not an allocation later
  kTimerSlack,    // 1 ns: the kernel does not gather wake-ups (for threads that are not SCHED_FIFO)
  kAffinity,      // the calling thread stays on its processors
  kIdleStates,    // /dev/cpu_dma_latency: the processors do not sleep deeply
  kPriority,      // SCHED_FIFO for the calling thread
};
inline constexpr std::size_t kRtSteps = 8;

/// How one step went. No text and no memory of its own, so that reporting cannot fail.
struct RtStep {
  RtStepKind kind = RtStepKind::kHeapKept;
  Grant grant = Grant::kSkipped;
  int error = 0;           // errno of a denial
  std::int64_t asked = 0;  // priority, bytes, microseconds: whatever the step asks for
  std::int64_t limit = 0;  // the resource limit that stood against it, -1 for none
};

/// The step in words.
Finding describe(const RtStep& step);

}  // namespace plumb::drivers
