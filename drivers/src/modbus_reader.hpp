// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modbus_spans.hpp"
#include "modbus_talk.hpp"
#include "packing_watch.hpp"

namespace plumb::drivers {

/// The reading half of a client. It polls the blocks of the other side with the periods of their
/// messages and passes valid messages on. To be used by one thread.
class ModbusReader {
 public:
  ModbusReader(const BusLayout& layout, ModbusCodec& codec, const ModbusClientSettings& settings,
               ModbusTalk& talk, ModbusExchange& exchange);

  /// The time from one round to the next.
  std::int64_t wake_ns() const noexcept { return wake_ns_; }

  /// Starts with a new connection: every block is due at once.
  void begin() noexcept;

  /// Reads the blocks that are due. Returns false if the connection can no longer be used.
  bool round(std::int64_t now_ns);

 private:
  struct Poll {
    ModbusSpan span;
    std::int64_t period_ns = 0;
    std::int64_t due_ns = 0;
  };

  Poll poll_of(const ModbusSpan& span) const;
  void split_if_gaps_are_refused(std::size_t poll);
  ModbusTalk::Result read(const ModbusSpan& span);
  void take(const ModbusBlock& block, const ModbusSpan& span, std::int64_t now_ns);
  bool look_around(const ModbusSpan& span, std::int64_t now_ns);

  ModbusCodec& codec_;
  ModbusTalk& talk_;
  ModbusExchange& exchange_;
  std::vector<Poll> polls_;
  PackingWatch packing_;
  std::int64_t wake_ns_ = 0;
  bool corrupt_ = false;      // a message of the last read was
  std::int64_t look_ns_ = 0;  // when it may next look around a message
  std::array<std::uint16_t, kMostRead> registers_{};
};

}  // namespace plumb::drivers
