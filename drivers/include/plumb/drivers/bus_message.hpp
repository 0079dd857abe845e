// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace plumb::drivers {

/// The kinds of messages on the bus. The layout (bus_layout.hpp) defines the names, units, scales
/// and places of their values; bus_content.hpp defines what the values mean.
enum class MessageKind : std::uint8_t {
  kJoints,      // controller: measured joint positions
  kCommanded,   // controller: commanded joint positions of the target; optional
  kTarget,      // controller: desired tool pose in the base frame
  kActual,      // controller: the tool pose it shows for its measured joints; SYNC compares it
  kController,  // controller: drives, mode, stop, enable, tool, frame, payload
  kRobot,       // controller: fingerprint of the robot's serial number
  kContext,     // controller: payload, temperatures, process time; optional
  kCorrected,   // plumb-rt: the tool pose to move to instead of the target
  kOffset,      // plumb-rt: the same as a difference from the target, if the layout asks for it
  kStatus,      // plumb-rt: state, mode, status, counters
  kSignature,   // plumb-rt: fingerprints of the running model and of its robot
};
inline constexpr std::size_t kMessageKinds = 11;

inline constexpr std::size_t kMaxMessageValues = 14;  // as many as one frame of CAN FD can hold

/// One complete and checked message, with its values in m, rad, kg, degC and s; NaN means unknown.
struct BusMessage {
  MessageKind kind = MessageKind::kJoints;
  std::uint8_t size = 0;      // number of values
  std::uint16_t counter = 0;  // cycle counter of the sender; classic CAN carries its lower 8 bits
  std::int64_t time_ns = 0;   // time of reception, CLOCK_MONOTONIC; the age is judged by it alone
  std::array<double, kMaxMessageValues> values = unknown();

  static constexpr std::array<double, kMaxMessageValues> unknown() {
    std::array<double, kMaxMessageValues> out{};
    out.fill(std::numeric_limits<double>::quiet_NaN());
    return out;
  }
};

}  // namespace plumb::drivers
