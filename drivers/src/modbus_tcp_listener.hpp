// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "link_thread.hpp"
#include "modbus_tcp_socket.hpp"
#include "plumb/drivers/modbus_service.hpp"
#include "plumb/drivers/modbus_settings.hpp"

namespace plumb::drivers {

/// The TCP side of a server. It accepts connections, limits their number and idle time, and
/// assembles requests from bytes.
class ModbusTcpListener {
 public:
  ModbusTcpListener(const ModbusServerSettings& settings, ModbusService& service,
                    ModbusExchange& exchange);

  std::optional<LinkFault> open();
  std::uint16_t port() const noexcept { return socket_.port; }
  void run(const LinkThread& thread);

 private:
  struct Peer {
    Descriptor socket;
    ModbusPeer who = 0;  // the connections are numbered from 1
    SocketAddress from = {};
    ModbusFramer framer;
    std::int64_t part_since_ns = 0;  // when the first byte of the incomplete request came
    std::int64_t request_ns = 0;     // when the last complete request came, or the connection
    bool served = false;
    bool over = false;
  };

  void await(const LinkThread& thread);
  std::int64_t next_deadline_ns() const;
  void accept_new(std::int64_t now_ns);
  void admit(Descriptor socket, const SocketAddress& from, std::int64_t now_ns);
  bool make_room(const SocketAddress& for_host);
  std::uint64_t host_of(const SocketAddress& from, std::uint64_t number) const;
  bool is_allowed(const SocketAddress& from) const;
  void serve(Peer& peer, std::int64_t now_ns);
  void serve_requests(Peer& peer, std::int64_t now_ns);
  bool answer(Peer& peer, std::int64_t now_ns);
  void judge_times(Peer& peer, std::int64_t now_ns);
  void drop_those_over();

  ModbusServerSettings settings_;
  ModbusService* service_;
  ModbusExchange* exchange_;
  std::vector<SocketAddress> allowed_;
  ModbusTcpSocket socket_;
  std::uint64_t connections_ = 0;
  std::int64_t accept_again_ns_ = 0;  // when to go on after running out of descriptors
  std::vector<Peer> peers_;
  std::vector<pollfd> events_;  // in this order: stop, new connections, peers
};

}  // namespace plumb::drivers
