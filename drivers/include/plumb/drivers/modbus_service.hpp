// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "plumb/drivers/modbus_frame.hpp"
#include "plumb/drivers/modbus_registers.hpp"

namespace plumb::drivers {

/// A connection to a server. Connections are numbered from 1, in the order in which they came;
/// those with the same `host` come from one machine.
struct ModbusPeer {
  constexpr ModbusPeer(std::uint64_t of_its_own) noexcept : number(of_its_own), host(of_its_own) {}
  constexpr ModbusPeer(std::uint64_t its_number, std::uint64_t its_host) noexcept
      : number(its_number), host(its_host) {}

  std::uint64_t number;
  std::uint64_t host;
};

/// Answers the requests of a server's peers, without I/O or allocation. Any sequence of bytes is a
/// request, which is either served or refused with an exception answer.
class ModbusService {
 public:
  ModbusService(ModbusRegisters& registers, ModbusCounters& counters, std::int64_t writer_hold_ns)
      : registers_(&registers), counters_(&counters), writer_hold_ns_(writer_hold_ns) {}

  /// The answer to `pdu`, 1 .. kMostPdu bytes, from connection `peer` (any number but 0). Valid
  /// until the next call.
  ///
  /// One connection writes at a time. A later one of the same host supersedes it: a controller that
  /// has lost its connection makes another one, and the server may not see the end of the first.
  /// What was on the way meanwhile is one request at most; a superseded connection that goes on
  /// writing after that is a second sender, as is any connection of another host.
  std::span<const std::uint8_t> answer(std::span<const std::uint8_t> pdu, const ModbusPeer& peer,
                                       std::int64_t now_ns) noexcept;
  std::span<const std::uint8_t> refuse(std::uint8_t function, ModbusException why) noexcept;

  /// To be called when a connection has ended: another one may then write.
  void leave(std::uint64_t peer) noexcept;

  /// True if a later connection of the same host writes instead of this one.
  bool is_superseded(const ModbusPeer& peer) const noexcept {
    return writer_.number > peer.number && writer_.host == peer.host;
  }

 private:
  using Bytes = std::span<const std::uint8_t>;
  Bytes read(Bytes pdu, std::int64_t now_ns) noexcept;
  Bytes write_single(Bytes pdu, const ModbusPeer& peer, std::int64_t now_ns) noexcept;
  Bytes write_multiple(Bytes pdu, const ModbusPeer& peer, std::int64_t now_ns) noexcept;
  Bytes read_write(Bytes pdu, const ModbusPeer& peer, std::int64_t now_ns) noexcept;
  Bytes served(std::size_t size) noexcept;
  Bytes registers_answer(std::uint8_t function, std::uint16_t first, std::uint16_t count,
                         std::int64_t now_ns) noexcept;
  /// Why a connection may not write these registers. None if it may; it then counts as the writer.
  std::optional<ModbusException> objection(std::uint16_t first, std::uint16_t count,
                                           const ModbusPeer& peer, std::int64_t now_ns) noexcept;
  bool holds(const ModbusPeer& peer, std::int64_t now_ns) noexcept;
  void store(std::uint16_t first, Bytes words, std::int64_t now_ns) noexcept;
  Bytes refuse_words(std::uint8_t function, ModbusException why, std::uint16_t first,
                     Bytes words) noexcept;

  ModbusRegisters* registers_;
  ModbusCounters* counters_;
  std::int64_t writer_hold_ns_;
  ModbusPeer writer_ = 0;      // the connection that wrote last; 0: none
  std::uint64_t belated_ = 0;  // the connection whose last request came after it was superseded
  std::int64_t written_ns_ = 0;
  std::array<std::uint8_t, kMostPdu> answer_{};
};

}  // namespace plumb::drivers
