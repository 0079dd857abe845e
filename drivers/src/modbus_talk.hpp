// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "modbus_connection.hpp"
#include "plumb/drivers/modbus_exchange.hpp"

namespace plumb::drivers {

/// The connection of a client, which counts all that happens to it. To be used by one thread.
class ModbusTalk {
 public:
  using Result = ModbusConnection::Result;

  explicit ModbusTalk(ModbusCounters& counters) noexcept : counters_(counters) {}

  /// Whether the peer has shown that it is there. A TCP peer has, by accepting the connection; a
  /// serial device can be opened even if nobody is at its other end.
  enum class Met : std::uint8_t { kYes, kNotYet };
  void begin(std::unique_ptr<ModbusConnection> connection, Met met) noexcept;
  void end() noexcept;

  Result read(std::uint16_t first, std::span<std::uint16_t> registers);
  Result write(std::uint16_t first, std::span<const std::uint16_t> registers);
  ModbusException exception() const noexcept { return connection_->exception(); }

  /// Returns false if the connection can no longer be used.
  static bool goes_on(Result result) noexcept {
    return result == Result::kDone || result == Result::kRefused;
  }

  /// True if since begin_round() no request was refused and no answer was corrupt or meant for
  /// another request.
  bool clean() const noexcept { return clean_; }
  void begin_round() noexcept { clean_ = true; }
  void note_unclean() noexcept { clean_ = false; }

 private:
  Result counted(Result result) noexcept;
  void met() noexcept;

  ModbusCounters& counters_;
  std::unique_ptr<ModbusConnection> connection_;
  bool met_ = false;
  bool clean_ = true;
};

}  // namespace plumb::drivers
