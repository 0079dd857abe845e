// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/drivers/can_frame.hpp"

namespace plumb::drivers {

/// One identifier to receive; it must match exactly.
struct CanFilter {
  std::uint32_t id = 0;
  CanFrame::Id id_kind = CanFrame::Id::kStandard;
};

struct CanLinkOptions {
  CanFrame::Format format = CanFrame::Format::kClassic;  // kFd includes classic frames
  enum class DataPhase : std::uint8_t { kSwitched, kOneRate } data_phase = DataPhase::kSwitched;

  /// Sizes of the socket's buffers as the kernel counts them, somewhat over 1 kB per frame. The
  /// send buffer is small, so that frames which had to wait are not sent when they are old.
  int receive_bytes = 256 << 10;
  int send_bytes = 16 << 10;
};

/// Counters of a CAN link. They only grow.
struct CanLinkCounters {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t malformed = 0;   // frames with an impossible size, length, identifier or format
  std::uint64_t remote = 0;      // remote frames, which are ignored
  std::uint64_t overflowed = 0;  // frames lost in the receive queue
  std::uint64_t not_sent = 0;    // no room, link down, or a frame that this link cannot send
  std::uint64_t clock_jumps = 0;
};

}  // namespace plumb::drivers
