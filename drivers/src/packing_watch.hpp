// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/modbus_codec.hpp"
#include "plumb/drivers/modbus_exchange.hpp"

namespace plumb::drivers {

/// Finds out how a peer packs its messages into registers, when their check sums are wrong: the
/// registers are read with words or bytes swapped, and one register further on or back. What makes
/// the sum of kInARow messages of a kind right, one after the other, is put into the exchange, for
/// people to read. Nothing is decoded by it.
///
/// A sum of 32 bits is right by chance once in 10^8 messages; kInARow times in a row it is not.
///
/// Heap: none. Thread: one, that of the link.
class PackingWatch {
 public:
  static constexpr int kInARow = 3;

  PackingWatch(const BusLayout& layout, const ModbusCodec& codec, ModbusExchange& exchange);

  /// The registers of a message have the right sum.
  void right(MessageKind kind, std::int64_t now_ns) noexcept;

  /// They do not, or could not be had where they should be. `around`: registers that the peer has
  /// shown or written, from the address `from` on.
  void wrong(MessageKind kind, std::uint16_t from, std::span<const std::uint16_t> around) noexcept;

  /// True if the sum of some message was right within the last second.
  bool understands(std::int64_t now_ns) const noexcept;

 private:
  static constexpr std::size_t kMostRegisters = 2 * kMaxMessageValues + 3;
  using Words = std::span<const std::uint16_t>;

  struct Suspicion {
    RegisterPacking packing;
    int messages = 0;  // in a row, of which it makes the sum right
    std::uint32_t last_sum = 0;
    bool right = false;  // the last message needed none
  };

  bool holds(const RegisterPacking& packing, ModbusCodec::Block block, Words there) const noexcept;
  bool find(ModbusCodec::Block block, std::uint16_t from, Words around,
            RegisterPacking& packing) const noexcept;
  Words at(const RegisterPacking& packing, ModbusCodec::Block block, std::uint16_t from,
           Words around) const noexcept;
  void publish() noexcept;

  const ModbusCodec& codec_;
  ModbusExchange& exchange_;
  bool high_first_;
  std::array<Suspicion, kMessageKinds> kinds_{};
  std::int64_t right_ns_ = 0;
};

}  // namespace plumb::drivers
