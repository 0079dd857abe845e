// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <ctime>

#include "plumb/drivers/receive_time.hpp"

namespace plumb::drivers {
namespace {

std::int64_t read_ns(clockid_t clock) noexcept {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

ClockReading ClockReading::now() noexcept {
  return {.monotonic_ns = read_ns(CLOCK_MONOTONIC), .date_ns = read_ns(CLOCK_REALTIME)};
}

bool ReceiveTime::date_was_set(ClockReading now) noexcept {
  const std::int64_t passed_ns = now.monotonic_ns - last_.monotonic_ns;
  const std::int64_t moved_ns = now.date_ns - last_.date_ns - passed_ns;
  last_ = now;
  return std::abs(moved_ns) > kSlack_ns + passed_ns / 1000;
}

void ReceiveTime::saw_empty(ClockReading before) noexcept {
  if (date_was_set(before)) ++jumps_;
  doubtful_ = false;
  empty_ns_ = before.monotonic_ns;
}

std::int64_t ReceiveTime::of_frame(std::int64_t stamp_ns, ClockReading after) noexcept {
  if (date_was_set(after)) {
    ++jumps_;
    doubtful_ = true;
  }
  if (stamp_ns <= 0 || doubtful_) return empty_ns_;
  const std::int64_t age_ns = after.date_ns - stamp_ns;
  return std::clamp(after.monotonic_ns - age_ns, empty_ns_, after.monotonic_ns);
}

}  // namespace plumb::drivers
