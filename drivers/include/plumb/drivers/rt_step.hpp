// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "plumb/drivers/finding.hpp"

namespace plumb::drivers {

/// The steps that make a process a real-time one, in the order in which they are taken.
enum class RtStepKind : std::uint8_t {
  kHeapKept,      // mallopt: freed memory stays in the process, and none comes from mmap
  kHeapTouched,   // the pages of the heap are mapped before the cycle begins
  kStackTouched,  // the pages of the calling thread's stack are mapped
  kMemoryLocked,  // mlockall: nothing is paged out, now or later. It follows the heap, so that a
                  // limit that is too small denies this step, not a later allocation
  kTimerSlack,    // 1 ns: the kernel does not group wake-ups (of threads that are not SCHED_FIFO)
  kAffinity,      // the calling thread stays on its processors
  kIdleStates,    // /dev/cpu_dma_latency: the processors do not sleep deeply
  kPriority,      // SCHED_FIFO for the calling thread
};
inline constexpr std::size_t kRtSteps = 8;

/// The result of one step. It has no text and no memory of its own, so that reporting cannot fail.
struct RtStep {
  RtStepKind kind = RtStepKind::kHeapKept;
  Grant grant = Grant::kSkipped;
  int error = 0;           // errno of a denial
  std::int64_t asked = 0;  // what the step requested: a priority, bytes or microseconds
  std::int64_t limit = 0;  // the resource limit that denied it, -1 for none
};

/// Describes the step in words.
Finding describe(const RtStep& step);

}  // namespace plumb::drivers
