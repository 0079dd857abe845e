// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "plumb/drivers/session.hpp"

namespace plumb::drivers {

/// One event on the cycle's thread.
struct RecordEntry {
  enum class What : std::uint8_t {
    kReceived,
    kSent,
    kNotSent,
    kTick,
    kState,  // the session, as it is after the entries before, is in RunShared::copy
  } what = What::kTick;
  SessionTick tick;         // kTick: input of the session's step, after the messages of the cycle
  std::uint32_t model = 0;  // kTick, kState: number of the model that the step used
  SessionState state = SessionState::kInit;  // kTick: after the step, with its reasons
  FaultCause cause = FaultCause::kNone;
  Lost lost = Lost::kNothing;
  std::uint64_t cycles = 0;   // kState: steps of the session so far
  BusMessage message = {};    // all others: the message
  std::uint64_t dropped = 0;  // set by the ring: entries that it had dropped before this one
};

/// Passes the events of the cycle to a thread that records them. When the ring is full, new events
/// are dropped and counted in lost(), so the cycle never waits.
///
/// put() is for one thread, take() for one thread. Wait-free; no allocation, no system call.
class RecordRing {
 public:
  static constexpr std::size_t kEntries = 1 << 14;  // over a second at 1 kHz

  /// False if the entry was dropped.
  bool put(const RecordEntry& entry) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) >= kEntries) {
      lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
    entries_[end % kEntries] = entry;
    entries_[end % kEntries].dropped = lost_.load(std::memory_order_relaxed);
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  bool take(RecordEntry& out) noexcept {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    out = entries_[begin % kEntries];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  std::array<RecordEntry, kEntries> entries_;
  alignas(64) std::atomic<std::size_t> begin_{0};
  alignas(64) std::atomic<std::size_t> end_{0};
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace plumb::drivers
