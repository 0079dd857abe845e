// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "plumb/drivers/rt_step.hpp"

namespace plumb::drivers {

/// The settings of a real-time process; 0, -1 or null skips the step.
struct RtRequest {
  int priority = 80;                     // SCHED_FIFO, 1 .. 99
  std::span<const int> processors = {};  // for the calling thread; empty: unchanged
  std::size_t heap_bytes = 8 << 20;      // heap to touch and keep
  std::size_t stack_bytes = 128 << 10;   // stack to touch
  enum class Lock : std::uint8_t { kNone, kAll } lock = Lock::kAll;
  std::int32_t idle_latency_us = 0;  // longest wake-up from idle; -1 skips the step
  const char* idle_latency_file = "/dev/cpu_dma_latency";
};

/// Makes this process, and the calling thread in particular, a real-time one.
///
/// Every step is tried, whatever became of the others. steps() tells which were denied; whether to
/// go on is up to the caller. Whether SCHED_FIFO is granted is found by requesting it, because no
/// file tells. Memory and heap settings apply to the process; stack, processors, timer slack and
/// priority to the calling thread. Construct it in the thread that will run the cycle, after the
/// model is loaded and before other threads are started.
///
/// The destructor allows the processors deep idle states again; all other settings remain.
/// Slow: it touches memory and makes a dozen system calls. Throws nothing, and allocates nothing
/// but the memory it touches.
class RtProcess {
 public:
  explicit RtProcess(const RtRequest& request) noexcept;
  ~RtProcess();
  RtProcess(const RtProcess&) = delete;
  RtProcess& operator=(const RtProcess&) = delete;

  std::span<const RtStep, kRtSteps> steps() const noexcept { return steps_; }
  const RtStep& step(RtStepKind kind) const noexcept {
    return steps_[static_cast<std::size_t>(kind)];
  }

  /// True if no step was denied.
  bool complete() const noexcept;

 private:
  int idle_states_ = -1;  // the open file that holds the request
  std::array<RtStep, kRtSteps> steps_;
};

}  // namespace plumb::drivers
