// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstdint>

#include "plumb/drivers/latency_histogram.hpp"
#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {

/// One tick of the cycle's clock.
struct Tick {
  std::int64_t time_ns = 0;     // point of the grid
  std::int64_t latency_ns = 0;  // delay from that point until the thread ran
  std::int64_t elapsed_ns = 0;  // time on the grid since the last tick: (1 + missed) periods
  std::uint64_t missed = 0;     // points of the grid skipped since the last tick
  int error = 0;                // errno if the clock could not sleep; the caller must then stop,
                                // or the cycle would run without waiting
};

/// Counters of a clock, which only grow; read them from the thread that waits.
struct ClockCounters {
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;      // points of the grid skipped
  std::uint64_t overruns = 0;    // waits that began after their point: the cycle took too long
  std::uint64_t late_wakes = 0;  // sleeps that ended a whole period late: the thread was delayed
  std::uint64_t regrids = 0;     // new grids, because the clock went backwards
};

/// Ticks at absolute times on a fixed grid, so that delays do not accumulate.
///
///     grid    |-------|-------|-------|-------|
///     cycle   ===     ===========     ===     ===     the third point fell into a cycle: missed
///
/// A point that passed before wait() began, or whose sleep ended a whole period late or more, is
/// counted and skipped. The grid stays as it is, so after a stop of ten seconds there is one tick
/// with missed = n, not a burst of n cycles, and two cycles start at least one period less the
/// latency of the first apart. A signal does not shorten the wait. If the clock went back past the
/// last tick, a new grid begins.
///
/// wait() is for one thread, allocates nothing, reads a clock and sleeps (system calls).
template <TimeSource Time = MonotonicTime>
class CycleClock {
 public:
  static constexpr std::int64_t kShortestPeriod_ns = 10'000;

  /// The grid begins now. A period below kShortestPeriod_ns is raised to it.
  explicit CycleClock(std::int64_t period_ns, Time time = {}) noexcept
      : period_ns_(std::max(period_ns, kShortestPeriod_ns)),
        time_(time),
        last_ns_(time_.now_ns()) {}

  Tick wait() noexcept {
    Tick tick;
    std::int64_t now_ns = skip_passed(time_.now_ns(), tick);
    while (tick.error == 0 && now_ns < next_ns(tick)) now_ns = sleep(tick);
    return delivered(tick, now_ns);
  }

  std::int64_t period_ns() const noexcept { return period_ns_; }
  const ClockCounters& counters() const noexcept { return counters_; }

  /// Latencies of all sleeps, including those whose tick was then skipped.
  const LatencyHistogram& latency() const noexcept { return latency_; }

 private:
  std::int64_t next_ns(const Tick& tick) const noexcept {
    return last_ns_ + (1 + static_cast<std::int64_t>(tick.missed)) * period_ns_;
  }

  std::int64_t skip_passed(std::int64_t now_ns, Tick& tick) noexcept {
    relay(now_ns, tick);
    if (now_ns <= next_ns(tick)) return now_ns;
    ++counters_.overruns;
    skip(now_ns, tick);
    return now_ns;
  }

  /// Skips all points at or before `now_ns`.
  void skip(std::int64_t now_ns, Tick& tick) const noexcept {
    tick.missed += static_cast<std::uint64_t>((now_ns - next_ns(tick)) / period_ns_ + 1);
  }

  void relay(std::int64_t now_ns, Tick& tick) noexcept {
    if (next_ns(tick) - now_ns <= period_ns_) return;
    ++counters_.regrids;
    counters_.missed += tick.missed;
    tick.missed = 0;
    last_ns_ = now_ns;
  }

  /// Sleeps until the next point and returns the time afterwards. If the sleep ended a period late,
  /// its point is skipped.
  std::int64_t sleep(Tick& tick) noexcept {
    const std::int64_t point_ns = next_ns(tick);
    const int error = time_.sleep_until_ns(point_ns);
    const std::int64_t now_ns = time_.now_ns();
    if (error != 0 && error != EINTR) tick.error = error;
    if (now_ns >= point_ns) {
      latency_.add(now_ns - point_ns);
    } else {
      relay(now_ns, tick);
    }
    if (now_ns - point_ns >= period_ns_) {
      ++counters_.late_wakes;
      skip(now_ns, tick);
    }
    return now_ns;
  }

  Tick delivered(Tick tick, std::int64_t now_ns) noexcept {
    tick.time_ns = next_ns(tick);
    tick.latency_ns = now_ns - tick.time_ns;
    tick.elapsed_ns = tick.time_ns - last_ns_;
    last_ns_ = tick.time_ns;
    ++counters_.ticks;
    counters_.missed += tick.missed;
    return tick;
  }

  std::int64_t period_ns_;
  Time time_;
  std::int64_t last_ns_;  // the point of the last tick
  ClockCounters counters_;
  LatencyHistogram latency_;
};

}  // namespace plumb::drivers
