// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>

namespace plumb::drivers {

/// What a cycle clock asks of time, in [ns] since some fixed instant.
/// sleep_until_ns returns 0 at or after that time, or an errno: EINTR if a signal came first.
template <class T>
concept TimeSource = requires(T source, std::int64_t time_ns) {
  { source.now_ns() }
  noexcept->std::same_as<std::int64_t>;
  { source.sleep_until_ns(time_ns) }
  noexcept->std::same_as<int>;
};

/// CLOCK_MONOTONIC: not moved when the date is set. One clock read, one sleep: a system call each
/// at most.
struct MonotonicTime {
  static std::int64_t now_ns() noexcept;
  static int sleep_until_ns(std::int64_t time_ns) noexcept;
};

}  // namespace plumb::drivers
