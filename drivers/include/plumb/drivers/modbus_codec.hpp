// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_message.hpp"
#include "plumb/drivers/can_codec.hpp"

namespace plumb::drivers {

/// Converts messages to holding registers and back, according to the layout. A block consists of
/// the values as int32 in two registers each, then a 16-bit counter, then CRC-32P4 in two
/// registers.
///
/// The checksum covers the block's first address as four bytes, low byte first, then the registers
/// before the checksum, each high byte first as on the wire.
///
/// Heap: only in the constructor. Thread: one. Cost: fixed. Errors: by value.
class ModbusCodec {
 public:
  explicit ModbusCodec(const BusLayout& layout);

  /// The registers of a message: the first and how many. {0, 0} if the layout has no such message.
  struct Block {
    std::uint16_t first = 0;
    std::uint16_t count = 0;
  };
  Block block(MessageKind kind) const noexcept;

  /// Fills the block of `message.kind`. False if the span does not have the size of the block.
  bool encode(const BusMessage& message, std::span<std::uint16_t> registers) const noexcept;

  /// Marks an encoded block as containing no message, by inverting its checksum.
  static void withdraw(std::span<std::uint16_t> registers) noexcept;

  /// The check sum of a block: of its first address, and of its registers before the check sum.
  static std::uint32_t check_sum(std::uint16_t address,
                                 std::span<const std::uint16_t> registers) noexcept;

  /// Decodes a block that was read; the caller must set the time of the message. The result is
  /// kRepeated if its counter equals the last one decoded, and kNotOurs if the layout has no such
  /// message. It is kNothing for a withdrawn block, and for a block of zeros before the first
  /// message, which was not written yet.
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
