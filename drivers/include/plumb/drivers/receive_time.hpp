// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumb::drivers {

/// Readings of CLOCK_MONOTONIC and CLOCK_REALTIME at the same moment.
struct ClockReading {
  std::int64_t monotonic_ns = 0;
  std::int64_t date_ns = 0;  // CLOCK_REALTIME

  static ClockReading now() noexcept;
};

/// Finds the time of reception of a frame on CLOCK_MONOTONIC.
///
/// The kernel stamps frames with the date (CLOCK_REALTIME), which can be set. Therefore a stamp is
/// limited by CLOCK_MONOTONIC: it cannot lie before the queue was last seen empty, nor after now.
/// If the date was set since then, or there is no stamp, the oldest possible time is used, which is
/// the moment when the queue was last seen empty. A frame may thus appear up to a cycle too old,
/// but never too new by more than kSlack_ns.
class ReceiveTime {
 public:
  /// The date counts as set if it deviates from CLOCK_MONOTONIC by more than this plus a thousandth
  /// of the elapsed time; NTP slews by at most half of that.
  static constexpr std::int64_t kSlack_ns = 1'000'000;

  explicit ReceiveTime(ClockReading now) noexcept : last_(now), empty_ns_(now.monotonic_ns) {}

  /// The queue was found empty; `before` was read before looking.
  void saw_empty(ClockReading before) noexcept;

  /// Time of a frame that was taken with this stamp (0: none); `after` was read after taking it.
  std::int64_t of_frame(std::int64_t stamp_ns, ClockReading after) noexcept;

  std::uint64_t jumps() const noexcept { return jumps_; }

 private:
  bool date_was_set(ClockReading now) noexcept;

  ClockReading last_;
  std::int64_t empty_ns_;
  bool doubtful_ = false;  // the date was set while frames may have been in the queue
  std::uint64_t jumps_ = 0;
};

}  // namespace plumb::drivers
