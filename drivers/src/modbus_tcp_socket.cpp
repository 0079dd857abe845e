// SPDX-License-Identifier: Apache-2.0
#include "modbus_tcp_socket.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

namespace plumb::drivers {
namespace {

LinkFault cannot_listen(const SocketAddress& address, int error) {
  const std::string where = text_of(address);
  switch (error) {
    case EADDRINUSE:
      return {"port", "something listens on " + where + " already", "ss -ltnp", error};
    case EACCES:
      return {"port", "no right to listen on " + where,
              "use a port above 1023, or grant CAP_NET_BIND_SERVICE", error};
    case EADDRNOTAVAIL:
      return {"host", where + " is no address of this machine", "ip -brief address", error};
    default:
      return {"host", "cannot listen on " + where + ": " + std::strerror(error), "ss -ltnp", error};
  }
}

std::optional<LinkFault> find_address(const ModbusServerSettings& settings, SocketAddress& out) {
  const auto& tcp = std::get<TcpAddress>(settings.at);
  auto address = socket_address(tcp.host, tcp.port);
  if (!address) address = interface_address(tcp.host, tcp.port);
  if (!address)
    return LinkFault{"host", "'" + tcp.host + "' is neither an address nor an interface with one",
                     "ip -brief address"};
  if (is_wildcard(*address) && settings.wildcard == ModbusServerSettings::Wildcard::kRefused)
    return LinkFault{"host", tcp.host + " would listen on every interface",
                     "name the interface or the address that the controller is on"};
  out = *address;
  return std::nullopt;
}

}  // namespace

std::optional<LinkFault> open_tcp_socket(const ModbusServerSettings& settings,
                                         ModbusTcpSocket& out) {
  SocketAddress address;
  if (auto fault = find_address(settings, address)) return fault;
  Descriptor socket(::socket(address.family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const std::string& host = std::get<TcpAddress>(settings.at).host;
  // Binding to an address alone does not exclude connections to it that arrive through another
  // interface.
  if (!socket_address(host, 0) &&
      ::setsockopt(socket.get(), SOL_SOCKET, SO_BINDTODEVICE, host.c_str(),
                   static_cast<socklen_t>(host.size())) != 0)
    return LinkFault{"host", "cannot bind to interface " + host + ": " + std::strerror(errno),
                     "write its address, or grant CAP_NET_RAW", errno};
  SocketAddress bound;
  bound.size = sizeof bound.storage;
  if (::bind(socket.get(), address.get(), address.size) != 0 ||
      ::listen(socket.get(), static_cast<int>(settings.most_connections)) != 0 ||
      ::getsockname(socket.get(), bound.get(), &bound.size) != 0)
    return cannot_listen(address, errno);
  out = {.descriptor = std::move(socket), .port = port_of(bound)};
  return std::nullopt;
}

}  // namespace plumb::drivers
