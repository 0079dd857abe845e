// SPDX-License-Identifier: Apache-2.0
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/net_tstamp.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "plumb/drivers/can_link.hpp"

namespace plumb::drivers {
namespace {

/// The error frames that tell the state of the bus. Single bus errors are left out, because a bad
/// cable causes thousands of them per second.
constexpr can_err_mask_t kErrors = CAN_ERR_TX_TIMEOUT | CAN_ERR_LOSTARB | CAN_ERR_CRTL |
                                   CAN_ERR_ACK | CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;
constexpr int kStamps = SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE;

int error_unless(bool good) noexcept { return good ? 0 : errno; }

ifreq request_for(const std::array<char, 16>& interface) noexcept {
  ifreq out{};
  static_assert(sizeof(out.ifr_name) == 16);
  std::copy(interface.begin(), interface.end(), out.ifr_name);
  return out;
}

template <class T>
bool set(int socket, int level, int option, const T& value) noexcept {
  return ::setsockopt(socket, level, option, &value, sizeof(value)) == 0;
}

can_filter exactly(const CanFilter& filter) noexcept {
  const bool extended = filter.id_kind == CanFrame::Id::kExtended;
  const canid_t bits = extended ? CAN_EFF_MASK : CAN_SFF_MASK;
  return {.can_id = filter.id | (extended ? CAN_EFF_FLAG : 0U),
          .can_mask = bits | CAN_EFF_FLAG | CAN_RTR_FLAG};
}

int index_of(int socket, const std::array<char, 16>& interface) noexcept {
  ifreq request = request_for(interface);
  return ::ioctl(socket, SIOCGIFINDEX, &request) == 0 ? request.ifr_ifindex : 0;
}

int bind_to(int socket, int index) noexcept {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  if (index == 0) return ENODEV;  // for the kernel, 0 means all interfaces
  return error_unless(
      ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0);
}

bool is_bound_to(int socket, int index) noexcept {
  sockaddr_can address{};
  socklen_t size = sizeof(address);
  return ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0 &&
         address.can_ifindex == index;
}

int set_filters(int socket, std::span<const CanFilter> listen) {
  std::vector<can_filter> filters(listen.size());
  std::transform(listen.begin(), listen.end(), filters.begin(), exactly);
  const auto bytes = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
  return error_unless(::setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), bytes) ==
                      0);
}

/// The steps of CanLink::open. Each returns 0 or an errno.
struct CanSocket {
  int socket;
  const CanStep& step;
  const CanLinkOptions& options;
  std::span<const CanFilter> listen;

  int take(CanStepKind kind) const {
    switch (kind) {
      case CanStepKind::kSocket:
        return socket < 0 ? errno : 0;
      case CanStepKind::kInterface:
        return is_can();
      case CanStepKind::kUp:
        return is_up();
      case CanStepKind::kFormat:
        return carries_format();
      case CanStepKind::kOptions:
        return set_options();
      case CanStepKind::kFilters:
        return set_filters(socket, listen);
      case CanStepKind::kBind:
        return bind_to(socket, index_of(socket, step.interface));
    }
    return EINVAL;
  }

  int is_can() const {
    ifreq request = request_for(step.interface);
    if (step.interface[0] == 0) return ENODEV;
    if (::ioctl(socket, SIOCGIFHWADDR, &request) != 0) return errno;
    return request.ifr_hwaddr.sa_family == ARPHRD_CAN ? 0 : EPFNOSUPPORT;
  }

  int is_up() const {
    ifreq request = request_for(step.interface);
    if (::ioctl(socket, SIOCGIFFLAGS, &request) != 0) return errno;
    return request.ifr_flags & IFF_UP ? 0 : ENETDOWN;
  }

  int carries_format() const {
    ifreq request = request_for(step.interface);
    if (options.format == CanFrame::Format::kClassic) return 0;
    if (::ioctl(socket, SIOCGIFMTU, &request) != 0) return errno;
    return request.ifr_mtu >= static_cast<int>(CANFD_MTU) ? 0 : EMSGSIZE;
  }

  /// The kernel may grant smaller queues than requested (net.core.rmem_max) without an error.
  int set_options() const {
    const int fd = options.format == CanFrame::Format::kFd ? 1 : 0;
    constexpr int kOn = 1, kOff = 0;
    return error_unless(set(socket, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, fd) &&
                        set(socket, SOL_CAN_RAW, CAN_RAW_LOOPBACK, kOn) &&
                        set(socket, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, kOff) &&
                        set(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kErrors) &&
                        set(socket, SOL_SOCKET, SO_TIMESTAMPING, kStamps) &&
                        set(socket, SOL_SOCKET, SO_RXQ_OVFL, kOn) &&
                        set(socket, SOL_SOCKET, SO_RCVBUF, options.receive_bytes) &&
                        set(socket, SOL_SOCKET, SO_SNDBUF, options.send_bytes));
  }
};

}  // namespace

CanOpening CanLink::open(std::string_view interface, std::span<const CanFilter> listen,
                         const CanLinkOptions& options) {
  CanOpening out;
  CanStep& step = out.step;
  step.format = options.format;
  if (interface.size() < step.interface.size())
    std::copy(interface.begin(), interface.end(), step.interface.begin());
  CanLink link(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW), options);
  const CanSocket socket{link.socket_, step, options, listen};
  for (int i = 0; i <= static_cast<int>(CanStepKind::kBind); ++i) {
    step.kind = static_cast<CanStepKind>(i);
    step.error = socket.take(step.kind);
    step.grant = step.error == 0 ? Grant::kGranted : Grant::kDenied;
    if (step.error != 0) return out;
  }
  link.interface_ = step.interface;
  link.listen_.assign(listen.begin(), listen.end());
  out.link.emplace(std::move(link));
  return out;
}

/// Sets up the socket again if its interface was removed and is back. Such a socket has lost its
/// filters as well.
bool CanLink::recover() const {
  const int index = index_of(socket_, interface_);
  if (interface_[0] == 0 || index == 0) return false;
  if (is_bound_to(socket_, index)) return true;
  return set_filters(socket_, listen_) == 0 && bind_to(socket_, index) == 0;
}

}  // namespace plumb::drivers
