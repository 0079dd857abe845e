// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "plumb/drivers/descriptor.hpp"
#include "plumb/drivers/modbus_settings.hpp"

namespace plumb::drivers {

/// The socket on which a server waits for connections.
struct ModbusTcpSocket {
  Descriptor descriptor;
  std::uint16_t port = 0;  // the actual port, also if 0 was requested
};

/// Binds and listens where the settings say, on an address or on all that comes through an
/// interface. On failure, the fault holds the system's reason and what to do.
std::optional<LinkFault> open_tcp_socket(const ModbusServerSettings& settings,
                                         ModbusTcpSocket& out);

}  // namespace plumb::drivers
