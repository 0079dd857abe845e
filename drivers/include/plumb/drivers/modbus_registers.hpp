// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/modbus_codec.hpp"
#include "plumb/drivers/modbus_exchange.hpp"

namespace plumb::drivers {

class PackingWatch;

/// The registers of a server: which of them exist, who may write them, and their values.
///
/// Heap: only in the constructor. Thread: one, that of the link.
class ModbusRegisters {
 public:
  ModbusRegisters(const BusLayout& layout, Sender self, std::int64_t stale_after_ns,
                  ModbusExchange& exchange);
  ~ModbusRegisters();
  ModbusRegisters(const ModbusRegisters&) = delete;
  ModbusRegisters& operator=(const ModbusRegisters&) = delete;

  /// True if registers first .. first + count - 1 lie between the first and the last register of
  /// the layout. Registers that belong to no message are 0.
  bool readable(std::uint16_t first, std::uint16_t count) const noexcept;
  /// True if all these registers belong to messages of the peer, or hold the number of a plumb-rt
  /// that owns them.
  bool writable(std::uint16_t first, std::uint16_t count) const noexcept;

  /// Reads registers, after our own messages were brought up to date. Precondition: readable(first,
  /// count). The result is valid until the next call.
  std::span<const std::uint16_t> read(std::uint16_t first, std::uint16_t count,
                                      std::int64_t now_ns) noexcept;

  /// Writes a register. Precondition: writable(address, 1). When the last register of a block is
  /// written, its message is delivered.
  void write(std::uint16_t address, std::uint16_t value, std::int64_t now_ns) noexcept;

  /// Looks at registers that the peer wrote where it may not: it may mean messages of the layout.
  void refused(std::uint16_t first, std::span<const std::uint16_t> words) noexcept;

 private:
  static constexpr std::size_t kAddresses = 65536;
  struct Message {
    MessageKind kind = MessageKind::kJoints;
    std::uint16_t first = 0;
    std::uint16_t count = 0;
    std::int64_t stale_after_ns = 0;
    std::int64_t time_ns = 0;  // ours only: when the cycle sent it
    bool sound = false;        // ours only: there is a message and its checksum is right
  };

  std::span<std::uint16_t> block(const Message& message) noexcept;
  void renew(Message& message, std::int64_t now_ns) noexcept;
  void hear(const Message& message, std::int64_t now_ns) noexcept;

  ModbusCodec codec_;
  ModbusExchange* exchange_;
  std::unique_ptr<PackingWatch> packing_;
  std::vector<std::uint16_t> values_;
  std::vector<bool> peers_;  // true if the peer may write the register
  std::size_t begin_ = kAddresses;
  std::size_t end_ = 0;
  std::vector<Message> ours_;
  std::vector<Message> theirs_;
};

}  // namespace plumb::drivers
