// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "plumb/drivers/modbus_frame.hpp"
#include "plumb/drivers/modbus_registers.hpp"

namespace plumb::drivers {

/// Answers the requests of a server's peers, without I/O or allocation. Any sequence of bytes is a
/// request, which is either served or refused with an exception answer.
class ModbusService {
 public:
  ModbusService(ModbusRegisters& registers, ModbusCounters& counters, std::int64_t writer_hold_ns)
      : registers_(&registers), counters_(&counters), writer_hold_ns_(writer_hold_ns) {}

  /// The answer to `pdu`, 1 .. kMostPdu bytes, from connection `peer` (any number but 0). Valid
  /// until the next call.
  std::span<const std::uint8_t> answer(std::span<const std::uint8_t> pdu, std::uint64_t peer,
                                       std::int64_t now_ns) noexcept;
  std::span<const std::uint8_t> refuse(std::uint8_t function, ModbusException why) noexcept;

  /// To be called when a connection has ended: another one may then write.
  void leave(std::uint64_t peer) noexcept;

 private:
  using Bytes = std::span<const std::uint8_t>;
  Bytes read(Bytes pdu, std::int64_t now_ns) noexcept;
  Bytes write_single(Bytes pdu, std::uint64_t peer, std::int64_t now_ns) noexcept;
  Bytes write_multiple(Bytes pdu, std::uint64_t peer, std::int64_t now_ns) noexcept;
  Bytes read_write(Bytes pdu, std::uint64_t peer, std::int64_t now_ns) noexcept;
  Bytes served(std::size_t size) noexcept;
  Bytes registers_answer(std::uint8_t function, std::uint16_t first, std::uint16_t count,
                         std::int64_t now_ns) noexcept;
  /// Why a connection may not write these registers. None if it may; it then counts as the writer.
  std::optional<ModbusException> objection(std::uint16_t first, std::uint16_t count,
                                           std::uint64_t peer, std::int64_t now_ns) noexcept;
  void store(std::uint16_t first, Bytes words, std::int64_t now_ns) noexcept;

  ModbusRegisters* registers_;
  ModbusCounters* counters_;
  std::int64_t writer_hold_ns_;
  std::uint64_t writer_ = 0;  // the connection that wrote last; 0: none
  std::int64_t written_ns_ = 0;
  std::array<std::uint8_t, kMostPdu> answer_{};
};

}  // namespace plumb::drivers
