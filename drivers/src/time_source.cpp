// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/time_source.hpp"

#include <ctime>

namespace plumb::drivers {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

}  // namespace

std::int64_t MonotonicTime::now_ns() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<std::int64_t>(time.tv_sec) * kSecond_ns + time.tv_nsec;
}

int MonotonicTime::sleep_until_ns(std::int64_t time_ns) noexcept {
  timespec time{};
  time.tv_sec = static_cast<time_t>(time_ns / kSecond_ns);
  time.tv_nsec = static_cast<long>(time_ns % kSecond_ns);
  return ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
}

}  // namespace plumb::drivers
