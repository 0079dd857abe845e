// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_link.hpp"

#include <linux/can.h>
#include <linux/errqueue.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "can_wire.hpp"

namespace plumb::drivers {
namespace {

/// The control data that the kernel delivers together with a frame.
struct Beside {
  std::int64_t stamp_ns = 0;  // 0 if there is none
  std::optional<std::uint32_t> overflow_total;
};

constexpr std::size_t kBesideBytes =
    CMSG_SPACE(sizeof(scm_timestamping)) + CMSG_SPACE(sizeof(std::uint32_t));

template <class T>
T content(const cmsghdr* header) noexcept {
  T out;
  std::memcpy(&out, CMSG_DATA(header), sizeof(out));
  return out;
}

Beside read_beside(msghdr& message) noexcept {
  Beside out;
  for (cmsghdr* h = CMSG_FIRSTHDR(&message); h != nullptr; h = CMSG_NXTHDR(&message, h)) {
    if (h->cmsg_level != SOL_SOCKET) continue;
    if (h->cmsg_type == SO_RXQ_OVFL) out.overflow_total = content<std::uint32_t>(h);
    if (h->cmsg_type != SCM_TIMESTAMPING) continue;
    const auto stamp = content<scm_timestamping>(h).ts[0];
    out.stamp_ns = static_cast<std::int64_t>(stamp.tv_sec) * 1'000'000'000 + stamp.tv_nsec;
  }
  return out;
}

bool is_gone(int error) noexcept {
  constexpr std::array kGone = {ENETDOWN, ENODEV,       ENXIO, EPIPE,
                                ENOTCONN, ECONNREFUSED, EBADF, ECONNRESET};
  return std::find(kGone.begin(), kGone.end(), error) != kGone.end();
}

std::array<std::uint8_t, 8> error_data(const canfd_frame& frame) noexcept {
  std::array<std::uint8_t, 8> out;
  std::copy_n(frame.data, out.size(), out.begin());
  return out;
}

}  // namespace

CanLink::CanLink(int socket, const CanLinkOptions& options) noexcept
    : socket_(socket), options_(options), time_(ClockReading::now()) {}

CanLink::CanLink(CanLink&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      options_(other.options_),
      interface_(other.interface_),
      listen_(std::move(other.listen_)),
      condition_(other.condition_),
      time_(other.time_),
      counters_(other.counters_),
      overflow_total_(other.overflow_total_) {}

CanLink::~CanLink() {
  if (socket_ >= 0) ::close(socket_);
}

bool CanLink::receive(CanFrame& frame) noexcept {
  for (int i = 0; i < kMostFramesACall; ++i) {
    const Taken taken = take(frame);
    if (taken != Taken::kOther) return taken == Taken::kFrame;
  }
  return false;
}

CanLink::Taken CanLink::take(CanFrame& frame) noexcept {
  canfd_frame wire;
  alignas(cmsghdr) std::array<char, kBesideBytes> control;
  iovec part{.iov_base = &wire, .iov_len = sizeof(wire)};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ClockReading before = ClockReading::now();
  const ssize_t bytes = ::recvmsg(socket_, &message, MSG_DONTWAIT);
  if (bytes <= 0) {
    const int error = bytes < 0 ? errno : EPIPE;  // 0 bytes: a socket pair was closed
    if (error == EAGAIN) time_.saw_empty(before);
    return failed(error);
  }
  const Beside beside = read_beside(message);
  frame.time_ns = time_.of_frame(beside.stamp_ns, ClockReading::now());
  if (beside.overflow_total) note_overflow(*beside.overflow_total);
  const bool whole = (message.msg_flags & MSG_TRUNC) == 0;
  switch (whole ? from_wire(wire, static_cast<std::size_t>(bytes), options_.format, frame)
                : WireKind::kMalformed) {
    case WireKind::kData:
      ++counters_.received;
      condition_.received(message.msg_flags & MSG_DONTROUTE ? CanCondition::From::kThisMachine
                                                            : CanCondition::From::kWire,
                          frame.time_ns);
      return Taken::kFrame;
    case WireKind::kError:
      condition_.hear(wire.can_id & CAN_ERR_MASK, error_data(wire), frame.time_ns);
      return Taken::kOther;
    case WireKind::kRemote:
      ++counters_.remote;
      return Taken::kOther;
    case WireKind::kMalformed:
      ++counters_.malformed;
      return Taken::kOther;
  }
  return Taken::kOther;
}

/// Handles a failed read. The kernel reports only once that the interface went down; frames that
/// were received before can still be read.
CanLink::Taken CanLink::failed(int error) noexcept {
  if (!is_gone(error)) return error == EAGAIN ? Taken::kNothing : Taken::kOther;
  condition_.interface_down(ClockReading::now().monotonic_ns);
  return error == ENETDOWN || error == ENODEV ? Taken::kOther : Taken::kNothing;
}

void CanLink::note_overflow(std::uint32_t total) noexcept {
  counters_.overflowed += total - std::exchange(overflow_total_, total);
}

bool CanLink::send(const CanFrame& frame) noexcept {
  canfd_frame wire;
  const std::size_t bytes = to_wire(frame, options_, wire);
  if (bytes == 0) return keep(false);
  if (condition_.bus_off()) {
    condition_.carrier(carrier(), ClockReading::now().monotonic_ns);
    if (condition_.bus_off()) return keep(false);
  }
  if (::send(socket_, &wire, bytes, MSG_DONTWAIT | MSG_NOSIGNAL) == static_cast<ssize_t>(bytes)) {
    condition_.sent();
    return keep(true);
  }
  if (is_gone(errno)) condition_.interface_down(ClockReading::now().monotonic_ns);
  if (errno == ENOBUFS || errno == EAGAIN) condition_.queue_full();
  return keep(false);
}

bool CanLink::keep(bool sent) noexcept {
  ++(sent ? counters_.sent : counters_.not_sent);
  return sent;
}

/// True if the CAN controller takes part in the bus traffic. This is asked before sending, because
/// for a controller that is bus-off the kernel accepts frames and drops them. Takes no lock.
bool CanLink::carrier() const noexcept {
  if (interface_[0] == 0) return false;
  ifreq request{};
  std::copy(interface_.begin(), interface_.end(), request.ifr_name);
  return ::ioctl(socket_, SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_RUNNING) != 0;
}

CanLinkCounters CanLink::counters() const noexcept {
  CanLinkCounters out = counters_;
  out.overflowed += condition_.errors().controller_overran;
  out.clock_jumps = time_.jumps();
  return out;
}

}  // namespace plumb::drivers
