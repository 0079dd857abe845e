// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "plumb/drivers/can_condition.hpp"
#include "plumb/drivers/can_frame.hpp"
#include "plumb/drivers/can_link_options.hpp"
#include "plumb/drivers/can_step.hpp"
#include "plumb/drivers/receive_time.hpp"

namespace plumb::drivers {

struct CanOpening;

/// Sends and receives frames over one CAN interface, through a raw SocketCAN socket.
///
/// Our own frames do not come back to us, but other programs of this machine (candump) see them.
/// receive() and send() never block, never allocate, take no lock of their own and make at most
/// kMostFramesACall + 1 system calls. Thread: one; recover() may run in another.
class CanLink {
 public:
  /// The most frames that receive() examines in one call before it returns false, so that a flood
  /// of unwanted frames cannot delay the cycle.
  static constexpr int kMostFramesACall = 64;

  /// Opens a link that receives these identifiers and no others. Slow. An interface that is
  /// missing, is down, or does not carry the format is refused; nothing has then been sent.
  static CanOpening open(std::string_view interface, std::span<const CanFilter> listen,
                         const CanLinkOptions& options);

  /// Takes over a socket that carries one struct can_frame or canfd_frame per datagram, for example
  /// one of a pair of AF_UNIX sockets (SOCK_SEQPACKET, SOCK_DGRAM). No option is set on it.
  CanLink(int socket, const CanLinkOptions& options) noexcept;
  ~CanLink();
  CanLink(CanLink&& other) noexcept;
  CanLink& operator=(CanLink&&) = delete;

  /// The next received data frame in the order of arrival, with its time of reception
  /// (receive_time.hpp). False: there is none. Remote frames, error frames and malformed frames are
  /// counted and skipped.
  bool receive(CanFrame& frame) noexcept;

  /// False: not sent, and counted as such. Length, format and identifier must be possible on this
  /// link; neither the kernel nor this function rounds lengths. While the controller is bus-off
  /// nothing is queued.
  bool send(const CanFrame& frame) noexcept;

  LinkState state() const noexcept { return condition_.state(); }
  CanLinkCounters counters() const noexcept;
  const CanErrorCounters& errors() const noexcept { return condition_.errors(); }
  std::uint64_t reconnects() const noexcept { return condition_.reconnects(); }

  /// Binds the socket again if the interface disappeared and returned under another index, as after
  /// an adapter was unplugged. An interface that only went down and up needs no help. To be called
  /// in state() kDown from a thread that may wait, because bind() takes a lock that is also held
  /// while any network is set up. It changes the socket and not this object, so the cycle may run
  /// at the same time. Allocates. False: the interface is not there.
  bool recover() const;

 private:
  enum class Taken : std::uint8_t { kFrame, kOther, kNothing };

  Taken take(CanFrame& frame) noexcept;
  Taken failed(int error) noexcept;
  bool keep(bool sent) noexcept;
  bool carrier() const noexcept;
  void note_overflow(std::uint32_t total) noexcept;

  int socket_ = -1;
  CanLinkOptions options_;
  std::array<char, 16> interface_ = {};  // empty if the socket was taken over
  std::vector<CanFilter> listen_;
  CanCondition condition_;
  ReceiveTime time_;
  CanLinkCounters counters_;
  std::uint32_t overflow_total_ = 0;  // as the kernel counts, modulo 2^32
};

/// A link, or the step that was denied.
struct CanOpening {
  CanStep step;
  std::optional<CanLink> link;
};

}  // namespace plumb::drivers
