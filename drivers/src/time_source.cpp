// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/time_source.hpp"

#include <ctime>

namespace plumb::drivers {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::int64_t read(clockid_t clock) noexcept {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<std::int64_t>(time.tv_sec) * kSecond_ns + time.tv_nsec;
}

}  // namespace

std::int64_t MonotonicTime::now_ns() noexcept { return read(CLOCK_MONOTONIC); }

std::int64_t MonotonicTime::suspended_ns() noexcept {
  const std::int64_t awake_ns = read(CLOCK_MONOTONIC);
  return read(CLOCK_BOOTTIME) - awake_ns;
}

int MonotonicTime::sleep_until_ns(std::int64_t time_ns) noexcept {
  timespec time{};
  time.tv_sec = static_cast<time_t>(time_ns / kSecond_ns);
  time.tv_nsec = static_cast<long>(time_ns % kSecond_ns);
  return ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
}

}  // namespace plumb::drivers
