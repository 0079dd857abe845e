// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_message.hpp"
#include "plumb/drivers/can_codec.hpp"

namespace plumb::drivers {

/// Messages to holding registers and back, by the layout: the values as int32 in two registers
/// each, then a 16-bit counter, then CRC-32P4 in two.
///
/// The check sum covers the block's first address as four bytes, low byte first, then the registers
/// before it, each as on the wire: high byte first.
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

  /// Makes the block of an encoded message one that holds none: its check sum is inverted.
  static void withdraw(std::span<std::uint16_t> registers) noexcept;

  /// The message in a block that was read; its time is the caller's to set. A counter that was
  /// decoded last is kRepeated, a kind that the layout lacks kNotOurs. A block of zeros
  /// before the first message was not written yet, and one that was withdrawn holds none: kNothing.
  Heard decode(MessageKind kind, std::span<const std::uint16_t> registers,
               BusMessage& out) noexcept;

 private:
  struct Known {
    bool present = false;
    std::uint8_t size = 0;
    Block block;
    std::array<double, kMaxMessageValues> scale{};
    bool heard = false;
    std::uint16_t last = 0;
  };

  const Known& known(MessageKind kind) const noexcept {
    return known_[static_cast<std::size_t>(kind)];
  }
  void put_pair(std::uint32_t bits, std::uint16_t* at) const noexcept;
  std::uint32_t get_pair(const std::uint16_t* at) const noexcept;

  ByteOrder word_order_;
  std::array<Known, kMessageKinds> known_{};
};

}  // namespace plumb::drivers
