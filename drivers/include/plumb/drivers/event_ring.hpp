// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/session.hpp"

namespace plumb::drivers {

/// What the session was in at the end of a cycle, as far as an operator wants to know when it
/// changes.
struct SessionMoment {
  std::int64_t time_ns = 0;  // CLOCK_MONOTONIC
  SessionState state = SessionState::kInit;
  FaultCause cause = FaultCause::kNone;
  CorrectionMode mode = CorrectionMode::kShadow;
  Status status = Status::kNoModel;
  Lost lost = Lost::kNothing;
  LinkState link = LinkState::kDown;
  WriteRefusal refusal = {};  // behind Lost::kAnswers
  std::uint32_t model = 0;    // number of the model
  double applied_m = 0.0;     // size of the correction that is sent
  double difference_m = 0.0;  // of the pose compared last

  /// True if the difference of `before` is worth an entry in the journal: state, cause, lost
  /// inputs, model, link, or whether the inverse refuses.
  bool differs(const SessionMoment& before) const noexcept {
    return state != before.state || cause != before.cause || lost != before.lost ||
           model != before.model || link != before.link ||
           refused(status) != refused(before.status);
  }
};

/// Passes such moments from the cycle to the thread that writes the journal. When the ring is full,
/// new moments are dropped and counted in lost(), so the cycle never waits.
///
/// put() is for one thread, take() for one thread. Wait-free; no allocation, no system call.
class EventRing {
 public:
  static constexpr std::size_t kEntries = 1 << 10;

  void put(const SessionMoment& moment) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) >= kEntries) {
      lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return;
    }
    entries_[end % kEntries] = moment;
    end_.store(end + 1, std::memory_order_release);
  }

  bool take(SessionMoment& out) noexcept {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    out = entries_[begin % kEntries];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  std::array<SessionMoment, kEntries> entries_;
  alignas(64) std::atomic<std::size_t> begin_{0};
  alignas(64) std::atomic<std::size_t> end_{0};
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace plumb::drivers
