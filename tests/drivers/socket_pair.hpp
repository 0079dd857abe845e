// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/can.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace plumb::tests {

/// Two sockets that carry datagrams as a CAN socket does. One end goes to a link, which closes it;
/// this is the other.
class SocketPair {
 public:
  explicit SocketPair(int type = SOCK_SEQPACKET) {
    if (::socketpair(AF_UNIX, type, 0, ends_.data()) != 0) ends_ = {-1, -1};
  }
  ~SocketPair() { hang_up(); }
  SocketPair(const SocketPair&) = delete;
  SocketPair& operator=(const SocketPair&) = delete;

  int link_end() const { return ends_[0]; }
  int other_end() const { return ends_[1]; }

  /// This end, to whoever closes it.
  int release() { return std::exchange(ends_[1], -1); }

  void hang_up() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

  template <class T>
  bool put(const T& frame) const {
    return put_bytes(&frame, sizeof(frame));
  }
  bool put_bytes(const void* bytes, std::size_t size) const {
    return ::send(ends_[1], bytes, size, MSG_DONTWAIT) == static_cast<ssize_t>(size);
  }

  /// The bytes of the next datagram; empty: none.
  std::vector<std::uint8_t> take() const {
    std::vector<std::uint8_t> out(256);
    const ssize_t size = ::recv(ends_[1], out.data(), out.size(), MSG_DONTWAIT);
    out.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return out;
  }

 private:
  std::array<int, 2> ends_ = {-1, -1};
};

/// A classic frame; flags of the identifier as in linux/can.h.
inline can_frame classic(canid_t id, const std::vector<std::uint8_t>& data) {
  can_frame out{};
  out.can_id = id;
  out.can_dlc = static_cast<__u8>(data.size());
  for (std::size_t i = 0; i < data.size() && i < 8; ++i) out.data[i] = data[i];
  return out;
}

inline canfd_frame fd(canid_t id, std::uint8_t length, std::uint8_t fill) {
  canfd_frame out{};
  out.can_id = id;
  out.len = length;
  for (std::size_t i = 0; i < length && i < sizeof(out.data); ++i) out.data[i] = fill;
  return out;
}

}  // namespace plumb::tests
