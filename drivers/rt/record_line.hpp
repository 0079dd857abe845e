// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "plumb/drivers/can_frame.hpp"
#include "plumb/drivers/session.hpp"

namespace plumb::drivers::rt {

/// A line as `candump -L` writes and canplayer reads: (seconds.microseconds) interface id#data, in
/// CAN FD id##flags data. Seconds are of CLOCK_MONOTONIC.
struct RecordLine {
  std::string interface;
  CanFrame frame;
};

/// Names of interfaces that are none, for what is no frame of the bus.
inline constexpr char kTickName[] = "tick";      // the session took a step
inline constexpr char kUnsentName[] = "unsent";  // an answer that the link did not take
inline constexpr char kGapName[] = "gap";        // the record could not keep up

std::string to_line(const RecordLine& line);
std::optional<RecordLine> parse_line(std::string_view text);

/// What the session was told and the model it went by, in the eight bytes of a frame.
struct RecordedTick {
  SessionTick told;
  std::uint32_t model = 0;  // 24 bits of its number, as a fingerprint has
};
CanFrame tick_frame(const RecordedTick& tick);
RecordedTick tick_in(const CanFrame& frame);

}  // namespace plumb::drivers::rt
