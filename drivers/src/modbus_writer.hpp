// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modbus_owner.hpp"
#include "modbus_spans.hpp"
#include "modbus_talk.hpp"
#include "write_refusals.hpp"

namespace plumb::drivers {

/// The writing half of a client. It writes the newest message of each kind, adjacent blocks with
/// one request, into registers that are the client's alone. To be used by one thread.
class ModbusWriter {
 public:
  ModbusWriter(const BusLayout& layout, const ModbusCodec& codec,
               const ModbusClientSettings& settings, ModbusTalk& talk, ModbusOwner& owner,
               ModbusExchange& exchange);

  /// Writes the new messages, if the registers are ours. Returns false if the connection can no
  /// longer be used.
  bool round(std::int64_t now_ns);

 private:
  bool take_fresh(const ModbusBlock& block, std::int64_t now_ns, BusMessage& message);
  bool write_run(std::int64_t now_ns);

  /// Adjacent blocks that are written with one request.
  struct Run {
    std::array<std::uint16_t, kMostWrite> registers{};
    std::uint16_t first = 0;
    std::uint16_t count = 0;
    std::array<std::size_t, kMessageKinds> blocks{};  // indices of them
    std::size_t messages = 0;

    std::span<const std::size_t> parts() const noexcept {
      return std::span(blocks).first(messages);
    }
    std::span<const std::uint16_t> content() const noexcept {
      return std::span(registers).first(count);
    }
  };

  void count(const Run& run, ModbusTalk::Result result, std::int64_t now_ns) noexcept;

  const ModbusCodec& codec_;
  const ModbusClientSettings& settings_;
  ModbusTalk& talk_;
  ModbusOwner& owner_;
  ModbusExchange& exchange_;
  std::vector<ModbusBlock> blocks_;
  WriteRefusals refusals_;
  Run run_;
};

}  // namespace plumb::drivers
