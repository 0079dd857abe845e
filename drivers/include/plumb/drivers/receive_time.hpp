// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumb::drivers {

/// The two clocks, read together.
struct ClockReading {
  std::int64_t monotonic_ns = 0;
  std::int64_t date_ns = 0;  // CLOCK_REALTIME

  static ClockReading now() noexcept;
};

/// When a frame came, on CLOCK_MONOTONIC.
///
/// The kernel stamps frames with the date, which can be set. So a stamp is believed only as far as
/// CLOCK_MONOTONIC bears it out: not before the queue was last seen empty, not after now. If the
/// date was set since then, or there is no stamp, the frame is as old as it can be: from the moment
/// the queue was last empty. Data may so look older than it is by a cycle, and never newer by more
/// than kSlack_ns.
class ReceiveTime {
 public:
  /// A date that moves no more than this, and a thousandth of the time that passed (NTP slews by
  /// half of that), was not set.
  static constexpr std::int64_t kSlack_ns = 1'000'000;

  explicit ReceiveTime(ClockReading now) noexcept : last_(now), empty_ns_(now.monotonic_ns) {}

  /// Nothing was there; `before` was read before looking.
  void saw_empty(ClockReading before) noexcept;

  /// A frame was there with this stamp (0: none); `after` was read after taking it.
  std::int64_t of_frame(std::int64_t stamp_ns, ClockReading after) noexcept;

  std::uint64_t jumps() const noexcept { return jumps_; }

 private:
  bool date_was_set(ClockReading now) noexcept;

  ClockReading last_;
  std::int64_t empty_ns_;
  bool doubtful_ = false;  // the date was set, and what queued before is not all taken
  std::uint64_t jumps_ = 0;
};

}  // namespace plumb::drivers
