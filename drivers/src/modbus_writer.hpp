// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modbus_spans.hpp"
#include "modbus_talk.hpp"

namespace plumb::drivers {

/// The writing half of a client. It writes the newest message of each kind, adjacent blocks with
/// one request. From time to time it reads back the messages that decide where the other side
/// moves. To be used by one thread.
class ModbusWriter {
 public:
  ModbusWriter(const BusLayout& layout, const ModbusCodec& codec,
               const ModbusClientSettings& settings, ModbusTalk& talk, ModbusExchange& exchange);

  /// Starts with a new connection: the next write is read back.
  void begin() noexcept { read_back_due_ns_ = 0; }

  /// Writes the new messages. Returns false if the connection can no longer be used.
  bool round(std::int64_t now_ns);

 private:
  bool take_fresh(const ModbusBlock& block, std::int64_t now_ns, BusMessage& message);
  bool write_run(std::int64_t now_ns);
  bool read_back();

  /// Adjacent blocks that are written with one request.
  struct Run {
    std::array<std::uint16_t, kMostWrite> registers{};
    std::uint16_t first = 0;
    std::uint16_t count = 0;
    int messages = 0;
    bool matters = false;

    std::span<const std::uint16_t> content() const noexcept {
      return std::span(registers).first(count);
    }
  };

  const ModbusCodec& codec_;
  const ModbusClientSettings& settings_;
  ModbusTalk& talk_;
  ModbusExchange& exchange_;
  std::vector<ModbusBlock> blocks_;
  Run run_;
  std::array<std::uint16_t, kMostWrite> found_{};
  std::int64_t read_back_due_ns_ = 0;
};

}  // namespace plumb::drivers
