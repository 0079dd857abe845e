// SPDX-License-Identifier: Apache-2.0
#include "rt/firewall_rule.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "plumb/drivers/modbus_address.hpp"
#include "program/file.hpp"

namespace plumb::drivers::rt {
namespace {

using Kind = BusEndpoint::Kind;

constexpr const char* kTcpFile = "etc/plumb/firewall.nft";

/// An address as nftables writes it: "ip" or "ip6", and the number.
struct Address {
  std::string family, number;
  bool loopback = false;
};

std::optional<Address> address_of(const std::string& text) {
  const auto socket = socket_address(text, 0);
  if (!socket) return std::nullopt;
  std::array<char, INET6_ADDRSTRLEN> out{};
  if (socket->family() == AF_INET) {
    const auto& number = reinterpret_cast<const sockaddr_in*>(socket->get())->sin_addr;
    ::inet_ntop(AF_INET, &number, out.data(), out.size());
    return Address{"ip", out.data(), std::string(out.data()).starts_with("127.")};
  }
  const auto& number = reinterpret_cast<const sockaddr_in6*>(socket->get())->sin6_addr;
  if (IN6_IS_ADDR_V4MAPPED(&number)) {
    ::inet_ntop(AF_INET, &number.s6_addr[12], out.data(), out.size());
    return Address{"ip", out.data(), number.s6_addr[12] == 127};
  }
  ::inet_ntop(AF_INET6, &number, out.data(), out.size());
  return Address{"ip6", out.data(), IN6_IS_ADDR_LOOPBACK(&number) != 0};
}

/// A name of an interface that means nothing else to nftables or a shell.
bool is_plain(const std::string& interface) {
  return !interface.empty() && interface.size() <= 15 &&
         std::ranges::all_of(interface, [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
         });
}

/// What a rule does, and a comment by which the kernel's list shows that it is this one.
std::string statement(const std::string& match, const std::string& verdict) {
  return fmt::format("{} counter {} comment \"plumb-rt {}\"", match, verdict,
                     sha256(match + verdict).substr(0, 12));
}

/// On what goes to a controller, or leaves our port: all that the service sends, and to `others`
/// what is said of everybody else's packets. The kernel sends without an owner what
/// belongs to no open socket: a refusal, the end of a connection, and the unsent bytes of whoever
/// has closed his socket. Of that passes what carries no byte and opens no connection: a TCP header
/// of 20 bytes, or of 32 with time stamps.
std::vector<std::string> by_the_service(const std::string& ours, const std::optional<Address>& at,
                                        const std::string& user, const char* others) {
  std::vector<std::string> out{
      statement(fmt::format("{} meta skuid \"{}\"", ours, user), "accept")};
  for (const auto& [family, header] : {std::pair{"ip", 20}, std::pair{"ip6", 0}}) {
    if (at && at->family != family) continue;
    for (const auto& [length, more] : {std::pair{20, ""}, std::pair{32, " tcp doff 8"}})
      out.push_back(statement(fmt::format("{} tcp flags & syn == 0 {} length {}{}", ours, family,
                                          header + length, more),
                              "accept"));
  }
  out.push_back(statement(ours, others));
  return out;
}

/// What is forwarded to the controller comes from a container, a virtual machine or a neighbouring
/// network, and has no user.
std::optional<FirewallRule> connecting(const std::string& place, const BusEndpoint& bus,
                                       const std::string& user) {
  const auto to = address_of(bus.address);
  if (!to) return std::nullopt;
  const std::string there =
      fmt::format("{} daddr {} tcp dport {}", to->family, to->number, bus.port);
  return FirewallRule{
      .file = kTcpFile,
      .says = fmt::format("{}: only user {} may connect to {}, port {}, and nothing is forwarded "
                          "there",
                          place, user, to->number, bus.port),
      .without = fmt::format("{}: every user of this machine, and every container, may connect to "
                             "{}, port {}",
                             place, to->number, bus.port),
      .output = by_the_service(there, to, user, "reject with tcp reset"),
      .forward = {statement(there, "reject with tcp reset")}};
}

/// For each family what is dropped on its way to our port: all that comes from no peer of it.
std::vector<std::string> from_strangers(const BusEndpoint& bus, const std::optional<Address>& at,
                                        const std::vector<Address>& peers) {
  std::vector<std::string> out;
  for (const char* family : {"ip", "ip6"}) {
    if (at && at->family != family) continue;
    std::vector<std::string> numbers;
    for (const Address& peer : peers)
      if (peer.family == family) numbers.push_back(peer.number);
    const std::string to = at ? fmt::format("{} daddr {}", family, at->number)
                              : fmt::format("iifname \"{}\" meta nfproto {}", bus.interface,
                                            family == std::string("ip") ? "ipv4" : "ipv6");
    const std::string from =
        numbers.empty() ? ""
                        : fmt::format(" {} saddr != {{ {} }}", family, fmt::join(numbers, ", "));
    out.push_back(statement(fmt::format("{} tcp dport {}{}", to, bus.port, from), "drop"));
  }
  return out;
}

/// What leaves our port.
std::string from_our_port(const BusEndpoint& bus, const std::optional<Address>& at) {
  return fmt::format("{} tcp sport {}",
                     at ? fmt::format("{} saddr {}", at->family, at->number)
                        : fmt::format("oifname \"{}\"", bus.interface),
                     bus.port);
}

std::optional<FirewallRule> listening(const std::string& place, const BusEndpoint& bus,
                                      const std::string& user) {
  const auto at = bus.interface.empty() ? address_of(bus.address) : std::nullopt;
  if (!at && !is_plain(bus.interface)) return std::nullopt;
  std::vector<Address> peers;
  for (const std::string& text : bus.peers)
    if (const auto peer = address_of(text)) peers.push_back(*peer);
  const bool local = std::ranges::any_of(peers, &Address::loopback);
  std::vector<std::string> names;
  for (const Address& peer : peers) names.push_back(peer.number);
  const std::string where = at ? at->number : bus.interface;
  const std::string ours = from_our_port(bus, at);
  return FirewallRule{
      .file = kTcpFile,
      .says = fmt::format("{}: only the peers {} reach port {} of {}, and only user {} answers "
                          "there{}",
                          place, fmt::join(names, ", "), bus.port, where, user,
                          local ? "; every user of this machine is such a peer" : ""),
      .without = fmt::format("{}: any user of this machine may answer at port {} of {} while "
                             "plumb-rt does not run",
                             place, bus.port, where),
      .output = by_the_service(ours, at, user, "drop"),
      .input = from_strangers(bus, at, peers),
      // A container that takes our address for its own.
      .forward = {statement(ours + (at ? "" : " fib saddr type local"), "drop")}};
}

/// CAN has no addresses and no ports, but what is sent on an interface passes its egress hook.
std::optional<FirewallRule> sending(const std::string& place, const BusEndpoint& bus,
                                    const std::string& user) {
  if (!is_plain(bus.interface)) return std::nullopt;
  return FirewallRule{.file = fmt::format("etc/plumb/firewall-{}.nft", bus.interface),
                      .says = fmt::format("{}: only user {} may send on {}; every user may listen",
                                          place, user, bus.interface),
                      .without = fmt::format(
                          "{}: every user of this machine may send on {}; a raw CAN socket needs "
                          "no right",
                          place, bus.interface),
                      .output = {statement(fmt::format("meta skuid \"{}\"", user), "accept")},
                      .can = bus.interface};
}

}  // namespace

std::optional<FirewallRule> firewall_rule(const std::string& place, const BusEndpoint& bus,
                                          const std::string& user) {
  switch (bus.kind) {
    case Kind::kConnects:
      return connecting(place, bus, user);
    case Kind::kListens:
      return listening(place, bus, user);
    case Kind::kCan:
      return sending(place, bus, user);
    case Kind::kNone:
      break;
  }
  return std::nullopt;
}

}  // namespace plumb::drivers::rt
