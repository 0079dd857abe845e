// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "plumb/drivers/rt_step.hpp"

namespace plumb::drivers {

/// What a real-time process asks for; 0, -1 or null skips a step.
struct RtRequest {
  int priority = 80;                     // SCHED_FIFO, 1 .. 99
  std::span<const int> processors = {};  // the calling thread's; empty: as they are
  std::size_t heap_bytes = 8 << 20;      // touched and kept
  std::size_t stack_bytes = 128 << 10;   // touched
  enum class Lock : std::uint8_t { kNone, kAll } lock = Lock::kAll;
  std::int32_t idle_latency_us = 0;  // longest wake-up from idle allowed; -1: not asked
  const char* idle_latency_file = "/dev/cpu_dma_latency";
};

/// Makes this process, and the calling thread, a real-time one.
///
/// Every step is tried, and none stops the others: what was denied stands in steps(), and whether
/// to go on is up to the caller. Whether SCHED_FIFO is granted is found by asking for it; no file
/// tells. Memory and heap settings are the process's; stack, processors, slack and priority the
/// calling thread's: construct it in the thread that will run the cycle, before others are started,
/// after the model is loaded.
///
/// The processors are kept from deep idle states until this object goes; all else stays.
/// Slow (touches memory, a dozen system calls); throws nothing and needs no memory but what it
/// touches.
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

  /// No step was denied.
  bool complete() const noexcept;

 private:
  int idle_states_ = -1;  // the open file that holds the request
  std::array<RtStep, kRtSteps> steps_;
};

}  // namespace plumb::drivers
