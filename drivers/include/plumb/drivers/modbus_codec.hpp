// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_message.hpp"
#include "plumb/drivers/can_codec.hpp"

namespace plumb::drivers {

/// Messages to holding registers and back, by the layout: the values as int32 in two registers
/// each, then a 16-bit counter, then CRC-32P4 in two.
///
/// Heap: only in the constructor. Thread: one. Cost: fixed. Errors: by value.
class ModbusCodec {
 public:
  explicit ModbusCodec(const BusLayout& layout);

  /// Registers of a message: where and how many; {0, 0} if the layout has no such message.
  struct Block {
    std::uint16_t first = 0;
    std::uint16_t count = 0;
  };
  Block block(MessageKind kind) const noexcept;

  /// Fills the block of `message.kind`; false if the span is not of its size.
  bool encode(const BusMessage& message, std::span<std::uint16_t> registers) const noexcept;

  /// The message in a block that was read. A block of zeros is corrupt: nothing was written yet.
  Heard decode(MessageKind kind, std::span<const std::uint16_t> registers,
               BusMessage& out) noexcept;
};

}  // namespace plumb::drivers
