// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "link_thread.hpp"
#include "modbus_connection.hpp"
#include "plumb/drivers/modbus_service.hpp"
#include "plumb/drivers/modbus_settings.hpp"

namespace plumb::drivers {

/// The serial side of a server. libmodbus delimits the requests and verifies their check sums.
class ModbusSerialListener {
 public:
  ModbusSerialListener(const ModbusServerSettings& settings, ModbusService& service,
                       ModbusExchange& exchange)
      : settings_(settings), service_(&service), exchange_(&exchange) {}

  /// Serves requests until the thread shall stop. Opens the line, and opens it again after it
  /// broke.
  void run(const LinkThread& thread);

 private:
  enum class Line : std::uint8_t { kGood, kBroken };
  void serve(modbus_t* context, const LinkThread& thread);
  bool await_request(int line, const LinkThread& thread);
  Line serve_request(modbus_t* context);
  Line answer(modbus_t* context, std::span<const std::uint8_t> frame);

  ModbusServerSettings settings_;
  ModbusService* service_;
  ModbusExchange* exchange_;
};

}  // namespace plumb::drivers
