// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/modbus_address.hpp"

namespace plumb::drivers {

struct ModbusClientSettings {
  ModbusAddress server = TcpAddress{};
  Sender self = Sender::kPlumb;
  std::uint8_t unit = 1;  // 0 .. 255; serial: 1 .. 247

  double poll_period_s = 0;         // 0: half the shortest period of the messages to read
  double response_timeout_s = 0.1;  // for a complete answer, and for a connection
  double first_back_off_s = 0.01;   // wait before the next attempt to connect; doubles each time
  double longest_back_off_s = 0.5;
  double stale_after_s = 0.1;  // a message of the cycle that waited longer is not written
  double watch_s = 0.3;  // how long registers that are in use must not change before we take them
  std::uint32_t token = 0;  // written into the layout's register for it; 0: a random number
};

struct ModbusServerSettings {
  enum class Wildcard : std::uint8_t { kRefused, kAllowed };

  ModbusAddress at = TcpAddress{};         // host: an address or interface ("eth1") of this machine
  Wildcard wildcard = Wildcard::kRefused;  // whether host may be 0.0.0.0 or ::
  std::vector<std::string> peers = {};     // TCP: addresses that may connect; one at least
  Sender self = Sender::kPlumb;
  std::uint8_t unit = 1;  // over TCP the units 0 and 255 are answered, too

  std::size_t most_connections = 4;
  double request_timeout_s = 0.1;  // from a request's first byte to its last
  double idle_timeout_s = 5.0;     // longest time without a complete request
  double stale_after_s = 0.1;      // a message of ours that is older loses its checksum
  double writer_hold_s = 0.5;      // how long after a write other connections may not write
};

}  // namespace plumb::drivers
