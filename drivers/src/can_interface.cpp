// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_interface.hpp"

#include <linux/can.h>
#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "netlink_attributes.hpp"

namespace plumb::drivers {
namespace {

struct Request {
  nlmsghdr header;
  ifinfomsg link;
};

class Netlink {
 public:
  Netlink() : socket_(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE)) {}
  ~Netlink() {
    if (socket_ >= 0) ::close(socket_);
  }
  Netlink(const Netlink&) = delete;
  Netlink& operator=(const Netlink&) = delete;

  bool ask_for_links() const {
    Request request{};
    request.header.nlmsg_len = sizeof(request);
    request.header.nlmsg_type = RTM_GETLINK;
    request.header.nlmsg_flags = NLM_F_REQUEST | NLM_F_DUMP;
    return ::send(socket_, &request, sizeof(request), 0) == sizeof(request);
  }

  /// The next messages; empty after the last.
  Bytes read() {
    const ssize_t bytes = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    return Bytes(buffer_).first(bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
  }

 private:
  int socket_;
  std::array<std::uint8_t, 32768> buffer_;
};

/// The bit rate that the kernel reports for an adapter on a serial line (slcan), because it does
/// not know the rate.
constexpr std::uint32_t kUnknown = 0xFFFFFFFF;

std::optional<std::uint32_t> rate(Bytes timing) {
  const auto found = head<can_bittiming>(timing);
  if (!found || found->bitrate == 0 || found->bitrate == kUnknown) return {};
  return found->bitrate;
}

CanInterface read_link(const ifinfomsg& link, Bytes row) {
  const Bytes info = attribute(row, IFLA_LINKINFO);
  const Bytes can = attribute(info, IFLA_INFO_DATA);
  return {.name = text(attribute(row, IFLA_IFNAME)),
          .kind = text(attribute(info, IFLA_INFO_KIND)),
          .up = (link.ifi_flags & IFF_UP) != 0,
          .carrier = (link.ifi_flags & IFF_RUNNING) != 0,
          .fd = head<std::uint32_t>(attribute(row, IFLA_MTU)).value_or(0) >= CANFD_MTU,
          .bit_rate = rate(attribute(can, IFLA_CAN_BITTIMING)),
          .data_bit_rate = rate(attribute(can, IFLA_CAN_DATA_BITTIMING)),
          .restart_ms = head<std::uint32_t>(attribute(can, IFLA_CAN_RESTART_MS))};
}

/// Adds the CAN interfaces in these messages to `out`. Returns true if more messages will follow.
bool read_links(Bytes messages, std::vector<CanInterface>& out) {
  while (const auto header = head<nlmsghdr>(messages)) {
    if (header->nlmsg_len < sizeof(nlmsghdr) || header->nlmsg_len > messages.size()) return false;
    if (header->nlmsg_type == NLMSG_DONE || header->nlmsg_type == NLMSG_ERROR) return false;
    const Bytes content = messages.first(header->nlmsg_len).subspan(sizeof(nlmsghdr));
    const auto link = head<ifinfomsg>(content);
    if (header->nlmsg_type == RTM_NEWLINK && link && link->ifi_type == ARPHRD_CAN)
      out.push_back(read_link(*link, behind(content, NLMSG_ALIGN(sizeof(ifinfomsg)))));
    messages = behind(messages, NLMSG_ALIGN(header->nlmsg_len));
  }
  return true;
}

}  // namespace

std::vector<CanInterface> read_can_interfaces() {
  std::vector<CanInterface> out;
  Netlink netlink;
  if (!netlink.ask_for_links()) return out;
  for (Bytes messages = netlink.read(); !messages.empty() && read_links(messages, out);)
    messages = netlink.read();
  return out;
}

std::optional<CanInterface> read_can_interface(const std::string& name) {
  const auto all = read_can_interfaces();
  const auto it = std::find_if(all.begin(), all.end(),
                               [&](const CanInterface& found) { return found.name == name; });
  if (it == all.end()) return {};
  return *it;
}

}  // namespace plumb::drivers
