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

/// The address of a Modbus TCP link. `host` is a numeric IPv4 or IPv6 address, because a name would
/// need a name server, which a factory may not have and which may take seconds. For a server it may
/// also be the name of a network interface.
struct TcpAddress {
  std::string host = "127.0.0.1";
  std::uint16_t port = 502;
};

/// The address of a Modbus RTU link: a serial device or a pseudo-terminal, with 8 data bits.
struct SerialLine {
  enum class Parity : char { kNone = 'N', kEven = 'E', kOdd = 'O' };
  std::string device;
  int baud = 115200;
  Parity parity = Parity::kEven;  // required by the Modbus serial line specification
  int stop_bits = 1;
};

using ModbusAddress = std::variant<TcpAddress, SerialLine>;

/// An address in the form that the kernel uses.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;

  const sockaddr* get() const noexcept { return reinterpret_cast<const sockaddr*>(&storage); }
  sockaddr* get() noexcept { return reinterpret_cast<sockaddr*>(&storage); }
  int family() const noexcept { return storage.ss_family; }
};

/// The socket address of a numeric host; none if `host` is not numeric.
std::optional<SocketAddress> socket_address(const std::string& host, std::uint16_t port);

/// The first address of a network interface, IPv4 before IPv6. None if there is no such interface
/// or it has no address.
std::optional<SocketAddress> interface_address(const std::string& name, std::uint16_t port);

bool is_wildcard(const SocketAddress& address) noexcept;  // stands for every interface
std::uint16_t port_of(const SocketAddress& address) noexcept;

/// True if both addresses are equal except for the port. An IPv4 address equals its mapping into
/// IPv6.
bool same_host(const SocketAddress& a, const SocketAddress& b) noexcept;

/// The address as text, for example "192.168.0.7:502" or "[::1]:502".
std::string text_of(const SocketAddress& address);

/// The address as text, for example "tcp 192.168.0.7:502" or "serial /dev/ttyUSB0 115200 8E1".
std::string text_of(const ModbusAddress& address);

/// Why a link cannot be started, in words for the program's message.
struct LinkFault {
  std::string key;   // the setting at fault: "host", "port", "device", "unit", ...
  std::string what;  // one sentence without a full stop
  std::string help;
  int error = 0;  // errno, if the system refused
};

}  // namespace plumb::drivers
