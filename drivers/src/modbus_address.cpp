// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_address.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>

#include <array>
#include <cstring>
#include <memory>

namespace plumb::drivers {
namespace {

constexpr std::array<std::uint8_t, 12> kMappedPrefix{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff};

template <class T>
T as(const SocketAddress& address) noexcept {
  T out;
  std::memcpy(&out, &address.storage, sizeof out);
  return out;
}

template <class T>
SocketAddress from(const T& native) noexcept {
  SocketAddress out;
  std::memcpy(&out.storage, &native, sizeof native);
  out.size = sizeof native;
  return out;
}

/// The address of the host as 16 bytes; IPv4 addresses are mapped into IPv6.
std::array<std::uint8_t, 16> host_bytes(const SocketAddress& address) noexcept {
  std::array<std::uint8_t, 16> out{};
  if (address.family() == AF_INET) {
    const auto native = as<sockaddr_in>(address);
    std::memcpy(out.data(), kMappedPrefix.data(), kMappedPrefix.size());
    std::memcpy(out.data() + kMappedPrefix.size(), &native.sin_addr, sizeof native.sin_addr);
  } else {
    const auto native = as<sockaddr_in6>(address);
    std::memcpy(out.data(), &native.sin6_addr, out.size());
  }
  return out;
}

bool is_mapped(const std::array<std::uint8_t, 16>& host) noexcept {
  return std::memcmp(host.data(), kMappedPrefix.data(), kMappedPrefix.size()) == 0;
}

SocketAddress with_port(SocketAddress address, std::uint16_t port) noexcept {
  const in_port_t wire = htons(port);
  const std::size_t at = address.family() == AF_INET ? offsetof(sockaddr_in, sin_port)
                                                     : offsetof(sockaddr_in6, sin6_port);
  std::memcpy(reinterpret_cast<std::uint8_t*>(&address.storage) + at, &wire, sizeof wire);
  return address;
}

std::optional<SocketAddress> of_family(const ifaddrs* list, const std::string& name, int family) {
  for (const ifaddrs* i = list; i != nullptr; i = i->ifa_next) {
    if (i->ifa_addr == nullptr || i->ifa_addr->sa_family != family || name != i->ifa_name) continue;
    SocketAddress out;
    out.size = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
    std::memcpy(&out.storage, i->ifa_addr, out.size);
    return out;
  }
  return std::nullopt;
}

}  // namespace

std::optional<SocketAddress> socket_address(const std::string& host, std::uint16_t port) {
  sockaddr_in v4{};
  v4.sin_family = AF_INET;
  v4.sin_port = htons(port);
  if (::inet_pton(AF_INET, host.c_str(), &v4.sin_addr) == 1) return from(v4);
  sockaddr_in6 v6{};
  v6.sin6_family = AF_INET6;
  v6.sin6_port = htons(port);
  if (::inet_pton(AF_INET6, host.c_str(), &v6.sin6_addr) == 1) return from(v6);
  return std::nullopt;
}

std::optional<SocketAddress> interface_address(const std::string& name, std::uint16_t port) {
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> kept(list, &::freeifaddrs);
  for (int family : {AF_INET, AF_INET6})
    if (const auto address = of_family(list, name, family)) return with_port(*address, port);
  return std::nullopt;
}

bool is_wildcard(const SocketAddress& address) noexcept {
  const auto host = host_bytes(address);
  const std::size_t from = is_mapped(host) ? kMappedPrefix.size() : 0;
  for (std::size_t i = from; i < host.size(); ++i)
    if (host[i] != 0) return false;
  return true;
}

std::uint16_t port_of(const SocketAddress& address) noexcept {
  return ntohs(address.family() == AF_INET ? as<sockaddr_in>(address).sin_port
                                           : as<sockaddr_in6>(address).sin6_port);
}

bool same_host(const SocketAddress& a, const SocketAddress& b) noexcept {
  return host_bytes(a) == host_bytes(b);
}

std::string text_of(const SocketAddress& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const std::string port = std::to_string(port_of(address));
  if (address.family() == AF_INET) {
    const auto v4 = as<sockaddr_in>(address);
    return std::string(::inet_ntop(AF_INET, &v4.sin_addr, text.data(), text.size())) + ":" + port;
  }
  const auto v6 = as<sockaddr_in6>(address);
  return "[" + std::string(::inet_ntop(AF_INET6, &v6.sin6_addr, text.data(), text.size())) +
         "]:" + port;
}

std::string text_of(const ModbusAddress& address) {
  if (const auto* tcp = std::get_if<TcpAddress>(&address))
    return "tcp " + tcp->host + ":" + std::to_string(tcp->port);
  const auto& line = std::get<SerialLine>(address);
  return "serial " + line.device + " " + std::to_string(line.baud) + " 8" +
         static_cast<char>(line.parity) + std::to_string(line.stop_bits);
}

}  // namespace plumb::drivers
