// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/modbus_address.hpp"
#include "plumb/drivers/modbus_exchange.hpp"
#include "plumb/drivers/modbus_settings.hpp"

namespace plumb::drivers {

/// A Modbus client for a controller that is the Modbus server: it polls the controller's messages
/// and writes ours.
///
/// It reads the blocks of the other side as often as the periods of their messages require. Over
/// TCP one request reads as many blocks as fit; once a server has refused the registers between
/// them, each block is read by itself. A message whose counter was seen before is not delivered
/// again. It writes the newest message of each kind.
///
/// The registers into which it writes are its own. Before every write, and over TCP in every round
/// or millisecond, it reads them and compares them with what it wrote last. What it did not
/// write counts as a foreign sender (modbus_owner.hpp). Registers that were in use when it came,
/// and those that another client took over, it watches without writing; while they change, each
/// change counts as a foreign sender.
///
/// An answer that is late, incomplete, too long, or belongs to another transaction, unit, protocol,
/// function or address ends the connection, so that a late answer cannot be taken for the next one.
/// Connecting is repeated without end, at intervals that grow up to a bound. An exception answer is
/// a valid answer: the link stays up, as LinkState::kDegraded.
///
/// Threads: start() and stop() must be called from one thread; between them the client has its own
/// thread, without real-time priority and with all signals blocked.
class ModbusClient {
 public:
  ModbusClient(const BusLayout& layout, const ModbusClientSettings& settings);
  ~ModbusClient();  // calls stop()
  ModbusClient(const ModbusClient&) = delete;
  ModbusClient& operator=(const ModbusClient&) = delete;

  /// Checks the settings and starts the thread. The server need not be there yet. Returns the
  /// fault, or none if the thread runs.
  std::optional<LinkFault> start();

  /// Stops the thread and returns when it has ended, within a response timeout.
  void stop();

  /// What a ModbusPort needs to be constructed.
  ModbusExchange& exchange() noexcept;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace plumb::drivers
