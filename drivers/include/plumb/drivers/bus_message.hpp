// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace plumb::drivers {

/// What is said on the bus. Which values a message has, their names, units, scales and places is
/// the business of the layout (bus_layout.hpp); what they mean, of bus_content.hpp.
enum class MessageKind : std::uint8_t {
  kJoints,      // controller: measured joint positions
  kCommanded,   // controller: commanded joint positions of the target; optional
  kTarget,      // controller: desired tool pose in the base frame
  kActual,      // controller: the tool pose it shows for its measured joints (SYNC compares it)
  kController,  // controller: drives, mode, stop, enable, tool, frame, payload
  kRobot,       // controller: who it is
  kContext,     // controller: payload, temperatures, process time; optional
  kCorrected,   // plumb-rt: the tool pose to go to instead of the target
  kOffset,      // plumb-rt: the same as a difference from the target (layout: offset mode)
  kStatus,      // plumb-rt: state, mode, status, counters
  kSignature,   // plumb-rt: which model runs
};
inline constexpr std::size_t kMessageKinds = 11;

inline constexpr std::size_t kMaxMessageValues = 14;  // what one frame of CAN FD can hold

/// One message, complete and checked, with its values in SI (m, rad, kg, degC, s); NaN: not known.
struct BusMessage {
  MessageKind kind = MessageKind::kJoints;
  std::uint8_t size = 0;      // of values
  std::uint16_t counter = 0;  // of the cycle that sent it; 8 bits of it survive classic CAN
  std::int64_t time_ns = 0;   // reception, CLOCK_MONOTONIC; age is judged by it alone
  std::array<double, kMaxMessageValues> values = unknown();

  static constexpr std::array<double, kMaxMessageValues> unknown() {
    std::array<double, kMaxMessageValues> out{};
    out.fill(std::numeric_limits<double>::quiet_NaN());
    return out;
  }
};

}  // namespace plumb::drivers
