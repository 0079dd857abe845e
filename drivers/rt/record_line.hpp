// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "plumb/drivers/can_frame.hpp"
#include "plumb/drivers/session.hpp"

namespace plumb::drivers::rt {

/// A line in the format that `candump -L` writes and canplayer reads: (seconds.microseconds)
/// interface id#data, in CAN FD id##flags data. The time is that of CLOCK_MONOTONIC.
struct RecordLine {
  std::string interface;
  CanFrame frame;
};

/// Names that stand in place of the interface on lines that are not frames of the bus.
inline constexpr char kStartName[] = "start";    // what the runs before left for the session
inline constexpr char kStateName[] = "state";    // a copy of the session (session_lines.hpp)
inline constexpr char kTickName[] = "tick";      // one step of the session
inline constexpr char kUnsentName[] = "unsent";  // an answer that could not be sent
inline constexpr char kGapName[] = "gap";        // the record lacks entries

std::string to_line(const RecordLine& line);
std::optional<RecordLine> parse_line(std::string_view text);

/// The input of one step of the session and the model it used, encoded in the 8 bytes of a frame.
struct RecordedTick {
  SessionTick told;
  std::uint32_t model = 0;  // its number: a fingerprint of 24 bits
};
CanFrame tick_frame(const RecordedTick& tick);
RecordedTick tick_in(const CanFrame& frame);

/// The beginning of a session, encoded likewise. A record without it began with nothing left.
CanFrame start_frame(const SessionStart& start, std::int64_t now_ns);
SessionStart start_in(const CanFrame& frame);

}  // namespace plumb::drivers::rt
