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
#include "plumb/drivers/can_step.hpp"
#include "plumb/drivers/receive_time.hpp"

namespace plumb::drivers {

/// One identifier to listen to, exactly.
struct CanFilter {
  std::uint32_t id = 0;
  CanFrame::Id id_kind = CanFrame::Id::kStandard;
};

struct CanLinkOptions {
  CanFrame::Format format = CanFrame::Format::kClassic;  // kFd: classic frames as well
  enum class DataPhase : std::uint8_t { kSwitched, kOneRate } data_phase = DataPhase::kSwitched;

  /// What the socket may hold, as the kernel counts: somewhat over 1 kB a frame. Little to send, so
  /// that what waits in vain does not come out old later.
  int receive_bytes = 256 << 10;
  int send_bytes = 16 << 10;
};

/// All monotone.
struct CanLinkCounters {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t malformed = 0;   // size, length, identifier or format that no data frame has
  std::uint64_t remote = 0;      // remote frames: ignored
  std::uint64_t overflowed = 0;  // lost in the receive queue
  std::uint64_t not_sent = 0;    // no room, down, or not a frame of this link
  std::uint64_t clock_jumps = 0;
};

struct CanOpening;

/// Frames over one CAN interface, through a raw SocketCAN socket.
///
/// Our own frames do not come back, but other programs of this machine see them (candump).
/// receive() and send() never block, never allocate, take no lock of ours and make at most
/// kMostFramesACall + 1 system calls. Thread: one; recover() may run in another.
class CanLink {
 public:
  /// Frames that receive() looks at in one call before it says there is none: a flood of what we
  /// do not want must not hold up the cycle.
  static constexpr int kMostFramesACall = 64;

  /// Slow. Listens to these identifiers and no others. An interface that is missing, down, or does
  /// not carry the format is refused: nothing was sent then.
  static CanOpening open(std::string_view interface, std::span<const CanFilter> listen,
                         const CanLinkOptions& options);

  /// Takes over a socket that carries struct can_frame and canfd_frame, one a datagram: a pair of
  /// AF_UNIX sockets (SOCK_SEQPACKET, SOCK_DGRAM) does. It is asked for nothing but frames.
  CanLink(int socket, const CanLinkOptions& options) noexcept;
  ~CanLink();
  CanLink(CanLink&& other) noexcept;
  CanLink& operator=(CanLink&&) = delete;

  /// The next data frame in the order of arrival, as it came, time included (receive_time.hpp);
  /// false: none. Remote and error frames, and what is no frame, are counted and skipped.
  bool receive(CanFrame& frame) noexcept;

  /// False: not sent, and counted. Of a length, format and identifier that this link has; the
  /// kernel does not round lengths, nor do we. While the controller is bus-off nothing is queued.
  bool send(const CanFrame& frame) noexcept;

  LinkState state() const noexcept { return condition_.state(); }
  CanLinkCounters counters() const noexcept;
  const CanErrorCounters& errors() const noexcept { return condition_.errors(); }
  std::uint64_t reconnects() const noexcept { return condition_.reconnects(); }

  /// Binds again to the interface if it went and came back under another index (an adapter that
  /// was unplugged). An interface that only went down and up needs no help. For state() kDown, from
  /// a thread that may wait: bind() takes a lock that whoever sets up any network holds. Changes
  /// the socket, not this object, so the cycle goes on beside it. Allocates. False: not there.
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
  std::array<char, 16> interface_ = {};  // empty: a socket of others
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
