// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstdint>

#include "plumb/drivers/latency_histogram.hpp"
#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {

/// One beat of the cycle.
struct Tick {
  std::int64_t time_ns = 0;     // the point of the grid
  std::int64_t latency_ns = 0;  // how much later the thread ran
  std::int64_t elapsed_ns = 0;  // since the tick before on the grid: (1 + missed) periods
  std::uint64_t missed = 0;     // points of the grid skipped since the tick before
  int error = 0;                // errno if the clock could not sleep: stop, or the cycle runs free
};

/// Monotone counters of a clock; read them from the thread that waits.
struct ClockCounters {
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;      // points of the grid skipped
  std::uint64_t overruns = 0;    // waits that began after their point: the cycle took too long
  std::uint64_t late_wakes = 0;  // sleeps that ended a whole period late: the thread was held up
  std::uint64_t regrids = 0;     // the clock went backwards
};

/// Ticks at absolute times on a fixed grid, so that no delay adds up.
///
///     grid    |-------|-------|-------|-------|
///     cycle   ===     ===========     ===     ===     the third point fell into a cycle: missed
///
/// Overrun: a point that passed before wait() began, and every point slept past by a whole period
/// or more, is counted and skipped. The grid stays, and two cycles never start closer than the
/// latency of the first: ten seconds stopped give one tick with missed = n, not n cycles in a
/// burst. A signal does not shorten the wait. If the clock went back past the last tick, the grid
/// is laid anew from then on.
///
/// wait(): one thread; no allocation; a clock read and a sleep (system calls).
template <TimeSource Time = MonotonicTime>
class CycleClock {
 public:
  static constexpr std::int64_t kShortestPeriod_ns = 10'000;

  /// period_ns below kShortestPeriod_ns counts as that. The grid begins now.
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

  /// Latency of every sleep, those included whose tick was then skipped.
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

  /// Points at or before `now_ns` are gone.
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

  /// Returns the time at the end. A sleep that ended a period late skips its point.
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
