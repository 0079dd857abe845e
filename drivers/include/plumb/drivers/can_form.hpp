// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/drivers/bus_layout.hpp"

namespace plumb::drivers {

/// How a message is divided into CAN frames. All of them have the same form: values, counter,
/// checksum, padding. Unused places are 0, and a frame in which they are not is refused.
///
///              values                     counter    checksum         padding
///   classic    2 x int24 at 0, 3          byte 6     CRC-8 at 7       none
///   offset     3 x int16 at 0, 2, 4       byte 6     CRC-8 at 7       none
///   FD         n x int32 at 0, 4, ...     2 bytes    CRC-32P4         to 8 .. 64 bytes
///
/// The checksum covers the identifier as four bytes, low byte first, then all bytes before itself.
struct CanForm {
  std::uint8_t frames = 0;
  std::uint8_t values = 0;        // values per frame
  std::uint8_t value_bytes = 0;   // value i is in frame i / values, byte (i % values) * value_bytes
  std::uint8_t counter_byte = 0;  // first byte and number of bytes, of counter and of checksum
  std::uint8_t counter_bytes = 0;
  std::uint8_t check_byte = 0;
  std::uint8_t check_bytes = 0;
  std::uint8_t length = 0;  // bytes of data in a frame
};

/// The form of a message of this layout.
CanForm can_form(const BusLayout& layout, const MessageLayout& message);

/// The most bits that a frame of this length takes on the wire, stuff bits and interframe space
/// included.
struct FrameBits {
  double slow = 0.0;  // bits at the arbitration bit rate
  double fast = 0.0;  // bits at the data bit rate of CAN FD
};
FrameBits worst_frame_bits(CanFrame::Format format, CanFrame::Id id_kind, std::size_t length);

}  // namespace plumb::drivers
