// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace plumb::drivers {

/// Modbus TCP. `host` is an address in numbers, IPv4 or IPv6: names need a name server, which a
/// factory may not have and which may take seconds. A server also takes the name of an interface.
struct TcpAddress {
  std::string host = "127.0.0.1";
  std::uint16_t port = 502;
};

/// Modbus RTU on a serial device or a pseudo-terminal, 8 data bits.
struct SerialLine {
  enum class Parity : char { kNone = 'N', kEven = 'E', kOdd = 'O' };
  std::string device;
  int baud = 115200;
  Parity parity = Parity::kEven;  // what the Modbus serial line specification asks for
  int stop_bits = 1;
};

using ModbusAddress = std::variant<TcpAddress, SerialLine>;

/// An address as the kernel takes it.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;

  const sockaddr* get() const noexcept { return reinterpret_cast<const sockaddr*>(&storage); }
  sockaddr* get() noexcept { return reinterpret_cast<sockaddr*>(&storage); }
  int family() const noexcept { return storage.ss_family; }
};

/// None: `host` is not an address in numbers.
std::optional<SocketAddress> socket_address(const std::string& host, std::uint16_t port);

/// The first address of a network interface, IPv4 before IPv6. None: no such interface, or bare.
std::optional<SocketAddress> interface_address(const std::string& name, std::uint16_t port);

bool is_wildcard(const SocketAddress& address) noexcept;  // every interface of the machine
bool is_loopback(const SocketAddress& address) noexcept;
std::uint16_t port_of(const SocketAddress& address) noexcept;

/// Equal but for the port. An IPv4 address equals itself mapped into IPv6.
bool same_host(const SocketAddress& a, const SocketAddress& b) noexcept;

/// "192.168.0.7:502", "[::1]:502"
std::string text_of(const SocketAddress& address);

/// "tcp 192.168.0.7:502", "serial /dev/ttyUSB0 115200 8E1"
std::string text_of(const ModbusAddress& address);

/// Why a link cannot be started: words for the program's message.
struct LinkFault {
  std::string key;   // of the settings: "host", "port", "device", "unit", ...
  std::string what;  // one sentence without a full stop
  std::string help;
  int error = 0;  // errno, if the system said no
};

}  // namespace plumb::drivers
