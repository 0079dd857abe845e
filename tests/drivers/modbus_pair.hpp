// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_port.hpp"
#include "plumb/drivers/modbus_server.hpp"
#include "tests/drivers/modbus_support.hpp"

namespace plumb::tests {

using namespace drivers;

/// A cycle's end of a link: sends lawful messages, hears others, and counts what is not lawful.
class Talker {
 public:
  Talker(ModbusExchange& exchange, const BusLayout& layout, Sender self)
      : layout_(&layout), port(exchange, layout, self), self_(self) {}

  void cycle() {
    ++counter;
    for (const auto& message : layout_->messages)
      if (message.sender == self_ && message.kind != silent)
        port.send(lawful(*layout_, message.kind, counter));
    BusMessage heard_now;
    while (port.receive(heard_now)) {
      if (!is_lawful(*layout_, heard_now)) ++unlawful;
      last[static_cast<std::size_t>(heard_now.kind)] = heard_now;
      ++heard;
    }
  }

  const std::optional<BusMessage>& newest(MessageKind kind) const {
    return last[static_cast<std::size_t>(kind)];
  }

 private:
  const BusLayout* layout_;

 public:
  ModbusPort port;
  std::optional<MessageKind> silent;  // is not sent
  std::uint16_t counter = 0;
  int heard = 0;
  int unlawful = 0;
  std::array<std::optional<BusMessage>, kMessageKinds> last;

 private:
  Sender self_;
};

inline bool all_of_the_other_side_heard(const BusLayout& layout, const Talker& talker,
                                        Sender other) {
  return std::all_of(layout.messages.begin(), layout.messages.end(), [&](const auto& message) {
    return message.sender != other || talker.newest(message.kind);
  });
}

inline std::string words(const std::optional<LinkFault>& fault) {
  return fault ? fault->key + ": " + fault->what + "; " + fault->help : "started";
}

/// Both sides in this process; each may be plumb-rt.
class Pair {
 public:
  Pair(const BusLayout& used, ModbusServerSettings at, ModbusClientSettings to, Sender client_is)
      : layout(used),
        server(layout,
               with_self(at, client_is == Sender::kPlumb ? Sender::kController : Sender::kPlumb)),
        fault(server.start()),
        client(layout, with_server(with_self(to, client_is), server.port())),
        near(client.exchange(), layout, client_is),
        far(server.exchange(), layout,
            client_is == Sender::kPlumb ? Sender::kController : Sender::kPlumb) {}

  template <class Settings>
  static Settings with_self(Settings settings, Sender self) {
    settings.self = self;
    return settings;
  }
  static ModbusClientSettings with_server(ModbusClientSettings settings, std::uint16_t port) {
    if (auto* tcp = std::get_if<TcpAddress>(&settings.server)) tcp->port = port;
    return settings;
  }

  void cycle() {
    near.cycle();
    far.cycle();
  }

  BusLayout layout;
  ModbusServer server;
  std::optional<LinkFault> fault;
  ModbusClient client;
  Talker near, far;
};

inline const ModbusServerSettings kAnyPort{.at = TcpAddress{.host = "127.0.0.1", .port = 0},
                                           .peers = {"127.0.0.1"}};

}  // namespace plumb::tests
