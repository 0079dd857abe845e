// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>

namespace plumb::drivers {

/// The source of time of a CycleClock, in [ns] since some fixed instant.
/// sleep_until_ns returns 0 at or after the given time, or an errno: EINTR if a signal arrived
/// first.
template <class T>
concept TimeSource = requires(T source, std::int64_t time_ns) {
  { source.now_ns() }
  noexcept->std::same_as<std::int64_t>;
  { source.sleep_until_ns(time_ns) }
  noexcept->std::same_as<int>;
};

/// CLOCK_MONOTONIC, which does not change when the date is set. Each function makes at most one
/// system call.
struct MonotonicTime {
  static std::int64_t now_ns() noexcept;
  static int sleep_until_ns(std::int64_t time_ns) noexcept;

  /// How long the machine was suspended since it started [ns], which CLOCK_MONOTONIC does not
  /// count: CLOCK_BOOTTIME is ahead of it by so much.
  static std::int64_t suspended_ns() noexcept;
};

}  // namespace plumb::drivers
