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

/// A Modbus server for controllers that poll. It offers the messages of the layout as holding
/// registers, and the same as input registers. It serves functions 3, 4, 6, 16 and 23 only.
///
/// The peer may read every register of the layout and write those of its own messages. A message is
/// taken when the last register of its checksum is written. Our messages are put into the registers
/// just before they are read. A message that the cycle did not renew keeps its values and counter
/// but loses its checksum. Before the first message the block is zeros, to which no checksum fits.
///
/// TCP is parsed by code of our own, which is fuzzed, and not by libmodbus. Foreign peers are
/// refused at once, and the number of connections and the time of a request are limited. A
/// connection ends if its framing is broken, a request arrives too slowly, nothing arrives, or the
/// peer does not read its answers. RTU frames are parsed by libmodbus; requests to other units and
/// broadcasts are ignored.
///
/// Threads: start() and stop() must be called from one thread; between them the server has its own
/// thread, as ModbusClient has.
class ModbusServer {
 public:
  ModbusServer(const BusLayout& layout, const ModbusServerSettings& settings);
  ~ModbusServer();  // calls stop()
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  /// Checks the settings, binds the address or opens the device, and starts the thread. Returns the
  /// fault, or none if the thread runs.
  std::optional<LinkFault> start();

  /// Stops the thread and returns when it has ended: within a few milliseconds, with RTU within a
  /// request timeout.
  void stop();

  /// The TCP port it listens on, also if 0 was asked for.
  std::uint16_t port() const noexcept;

  /// What a ModbusPort needs to be constructed.
  ModbusExchange& exchange() noexcept;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace plumb::drivers
