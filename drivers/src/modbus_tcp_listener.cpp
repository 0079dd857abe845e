// SPDX-License-Identifier: Apache-2.0
#include "modbus_tcp_listener.hpp"

#include <netinet/tcp.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <utility>

#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {
namespace {

constexpr std::size_t kBeforePeers = 2;  // events of the thread and of new connections
/// Pause after a connection could not be accepted for lack of file descriptors; without it the
/// thread would try all the time.
constexpr std::int64_t kPauseWithoutDescriptors_ns = 100'000'000;
constexpr std::uint8_t kAnyUnit[] = {0, 255};  // sent by controllers that do not address units

}  // namespace

ModbusTcpListener::ModbusTcpListener(const ModbusServerSettings& settings, ModbusService& service,
                                     ModbusExchange& exchange)
    : settings_(settings), service_(&service), exchange_(&exchange) {
  for (const auto& peer : settings.peers)
    if (const auto address = socket_address(peer, 0)) allowed_.push_back(*address);
  peers_.reserve(settings.most_connections);
}

std::optional<LinkFault> ModbusTcpListener::open() { return open_tcp_socket(settings_, socket_); }

void ModbusTcpListener::run(const LinkThread& thread) {
  while (!thread.stopping()) {
    await(thread);
    if (thread.stopping()) break;
    const std::int64_t now_ns = MonotonicTime::now_ns();
    for (std::size_t i = 0; i < peers_.size(); ++i) {
      if (events_[kBeforePeers + i].revents != 0) serve(peers_[i], now_ns);
      judge_times(peers_[i], now_ns);
    }
    drop_those_over();
    if (events_[1].revents != 0) accept_new(now_ns);
    const bool up = std::ranges::any_of(peers_, [](const Peer& peer) { return peer.served; });
    exchange_->state = up ? LinkState::kUp : LinkState::kDown;
  }
  for (Peer& peer : peers_) peer.over = true;
  drop_those_over();
  exchange_->state = LinkState::kDown;
  socket_.descriptor = Descriptor();
}

void ModbusTcpListener::await(const LinkThread& thread) {
  const bool accepting = MonotonicTime::now_ns() >= accept_again_ns_;
  events_.clear();
  events_.push_back({.fd = thread.stop_event(), .events = POLLIN, .revents = 0});
  events_.push_back(
      {.fd = accepting ? socket_.descriptor.get() : -1, .events = POLLIN, .revents = 0});
  for (const Peer& peer : peers_)
    events_.push_back({.fd = peer.socket.get(), .events = POLLIN, .revents = 0});
  const std::int64_t deadline_ns = next_deadline_ns();
  const bool for_ever = deadline_ns == std::numeric_limits<std::int64_t>::max();
  const timespec wait = wait_until(for_ever ? 0 : deadline_ns);
  if (::ppoll(events_.data(), events_.size(), for_ever ? nullptr : &wait, nullptr) <= 0)
    for (pollfd& event : events_) event.revents = 0;
}

std::int64_t ModbusTcpListener::next_deadline_ns() const {
  std::int64_t next_ns = std::numeric_limits<std::int64_t>::max();
  if (accept_again_ns_ > MonotonicTime::now_ns()) next_ns = accept_again_ns_;
  for (const Peer& peer : peers_) {
    next_ns = std::min(next_ns, peer.request_ns + to_ns(settings_.idle_timeout_s));
    if (peer.part_since_ns != 0)
      next_ns = std::min(next_ns, peer.part_since_ns + to_ns(settings_.request_timeout_s));
  }
  return next_ns;
}

void ModbusTcpListener::accept_new(std::int64_t now_ns) {
  for (std::size_t i = 0; i <= settings_.most_connections; ++i) {
    SocketAddress from;
    from.size = sizeof from.storage;
    Descriptor socket(
        ::accept4(socket_.descriptor.get(), from.get(), &from.size, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (socket.get() >= 0) {
      admit(std::move(socket), from, now_ns);
    } else if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
      accept_again_ns_ = now_ns + kPauseWithoutDescriptors_ns;
      return;
    } else if (errno != ECONNABORTED && errno != EINTR) {
      return;
    }
  }
}

void ModbusTcpListener::admit(Descriptor socket, const SocketAddress& from, std::int64_t now_ns) {
  if (!is_allowed(from)) {
    ++exchange_->counters.foreign_peers;
    return;
  }
  if (peers_.size() >= settings_.most_connections && !make_room(from)) {
    ++exchange_->counters.crowded_out;
    return;
  }
  const int on = 1;
  ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  const std::uint64_t number = ++connections_, host = host_of(from, number);
  Peer& peer = peers_.emplace_back();
  peer.socket = std::move(socket);
  peer.who = {number, host};
  peer.from = from;
  peer.request_ns = now_ns;
  ++exchange_->counters.connects;
}

/// The number of the first connection of this host that is there still.
std::uint64_t ModbusTcpListener::host_of(const SocketAddress& from, std::uint64_t number) const {
  const auto found =
      std::ranges::find_if(peers_, [&](const Peer& peer) { return same_host(peer.from, from); });
  return found == peers_.end() ? number : found->who.host;
}

/// Ends a connection of this host that a later one has superseded. False: there is none.
bool ModbusTcpListener::make_room(const SocketAddress& for_host) {
  const auto old = std::ranges::find_if(peers_, [&](const Peer& peer) {
    return same_host(peer.from, for_host) && service_->is_superseded(peer.who);
  });
  if (old == peers_.end()) return false;
  old->over = true;
  drop_those_over();
  return true;
}

bool ModbusTcpListener::is_allowed(const SocketAddress& from) const {
  return std::ranges::any_of(allowed_,
                             [&](const SocketAddress& peer) { return same_host(peer, from); });
}

void ModbusTcpListener::serve(Peer& peer, std::int64_t now_ns) {
  const auto room = peer.framer.room();
  const ssize_t got = ::recv(peer.socket.get(), room.data(), room.size(), MSG_DONTWAIT);
  if (got > 0) {
    peer.framer.filled(static_cast<std::size_t>(got));
    serve_requests(peer, now_ns);
  } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
    peer.over = true;
  }
}

void ModbusTcpListener::serve_requests(Peer& peer, std::int64_t now_ns) {
  for (;;) {
    switch (peer.framer.next()) {
      case ModbusFramer::Cut::kBroken:
        ++exchange_->counters.bad_frames;
        peer.over = true;
        return;
      case ModbusFramer::Cut::kPart:
        if (!peer.framer.part()) peer.part_since_ns = 0;
        if (peer.framer.part() && peer.part_since_ns == 0) peer.part_since_ns = now_ns;
        return;
      case ModbusFramer::Cut::kFrame:
        peer.part_since_ns = 0;
        if (!answer(peer, now_ns)) {
          peer.over = true;
          return;
        }
    }
  }
}

/// Sends an answer. Returns false if the peer does not take it.
bool ModbusTcpListener::answer(Peer& peer, std::int64_t now_ns) {
  const MbapHeader& request = peer.framer.header();
  const bool known = request.unit == settings_.unit ||
                     std::ranges::find(kAnyUnit, request.unit) != std::end(kAnyUnit);
  const auto pdu = known ? service_->answer(peer.framer.pdu(), peer.who, now_ns)
                         : service_->refuse(peer.framer.pdu()[0], ModbusException::kNoSuchUnit);
  peer.request_ns = now_ns;
  peer.served = true;
  std::array<std::uint8_t, kMostTcpFrame> frame;
  put_header({.transaction = request.transaction,
              .unit = request.unit,
              .pdu_size = static_cast<std::uint16_t>(pdu.size())},
             frame);
  std::ranges::copy(pdu, frame.begin() + kMbapHeader);
  const std::size_t size = kMbapHeader + pdu.size();
  return ::send(peer.socket.get(), frame.data(), size, MSG_NOSIGNAL | MSG_DONTWAIT) ==
         static_cast<ssize_t>(size);
}

void ModbusTcpListener::judge_times(Peer& peer, std::int64_t now_ns) {
  const bool dripped =
      peer.part_since_ns != 0 && now_ns - peer.part_since_ns >= to_ns(settings_.request_timeout_s);
  const bool silent = now_ns - peer.request_ns >= to_ns(settings_.idle_timeout_s);
  if (peer.over || (!dripped && !silent)) return;
  ++exchange_->counters.timeouts;
  peer.over = true;
}

void ModbusTcpListener::drop_those_over() {
  const auto over = std::stable_partition(peers_.begin(), peers_.end(),
                                          [](const Peer& peer) { return !peer.over; });
  for (auto peer = over; peer != peers_.end(); ++peer) {
    service_->leave(peer->who.number);
    ++exchange_->counters.disconnects;
  }
  peers_.erase(over, peers_.end());
}

}  // namespace plumb::drivers
