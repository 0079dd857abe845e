// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/modbus_address.hpp"
#include "plumb/drivers/modbus_exchange.hpp"

namespace plumb::drivers {

struct ModbusClientSettings {
  ModbusAddress server = TcpAddress{};
  Sender self = Sender::kPlumb;
  std::uint8_t unit = 1;  // 0 .. 255; serial: 1 .. 247

  double poll_period_s = 0;         // 0: half the shortest period among the messages to read
  double response_timeout_s = 0.1;  // for a whole answer, and for a connection
  double first_back_off_s = 0.01;   // before a connection is tried again; doubles
  double longest_back_off_s = 0.5;
  double stale_after_s = 0.1;       // a message of the cycle that waited longer is not written
  double read_back_period_s = 0.1;  // how often what was written last is read again
};

/// Speaks to a controller that is the Modbus server: polls its messages, writes ours.
///
/// Reads the blocks of the other side, over TCP as many as fit in one request (block by block once
/// a server refused the registers between them), as often as their messages ask for. A counter seen
/// before is no news and is not delivered. Writes the newest message of
/// each kind, then, now and then and after every connection, reads it back: libmodbus and this
/// client check every field of an answer, but only reading shows what a register holds.
///
/// An answer that is late, cut short, too long or of another transaction, unit, protocol, function
/// or address ends the connection: whatever is still under way is lost with it, and cannot pass
/// for the next answer. Connections are tried again for ever, ever more slowly, up to a bound. An
/// exception answer is sound: the link stays, as LinkState::kDegraded.
///
/// Threads: start() and stop() from one; it has its own thread between. That thread has no
/// real-time priority and takes no signals.
class ModbusClient {
 public:
  ModbusClient(const BusLayout& layout, const ModbusClientSettings& settings);
  ~ModbusClient();  // stops
  ModbusClient(const ModbusClient&) = delete;
  ModbusClient& operator=(const ModbusClient&) = delete;

  /// Checks the settings and starts. The server need not be there yet. None: running.
  std::optional<LinkFault> start();

  /// Returns when the thread has ended: within a response timeout.
  void stop();

  /// For a ModbusPort.
  ModbusExchange& exchange() noexcept;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace plumb::drivers
