// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/drivers/bus_message.hpp"

namespace plumb::drivers {

/// Counters of a link. They only grow.
struct PortCounters {
  std::uint64_t received = 0;  // complete and valid messages
  std::uint64_t sent = 0;
  std::uint64_t corrupt = 0;     // a checksum, length or range was wrong
  std::uint64_t repeated = 0;    // a counter was received again
  std::uint64_t skipped = 0;     // counters that were never received
  std::uint64_t overflowed = 0;  // messages lost in our own receive queue
  std::uint64_t not_sent = 0;    // the transmit queue was full or the link down
  std::uint64_t reconnects = 0;
  std::uint64_t restarts = 0;         // times that the controller was seen to have been restarted
  std::uint64_t foreign_senders = 0;  // our own identifier, sent by someone else
  std::uint64_t refused_writes = 0;   // writes that the peer answered with an exception
};

/// What the peer does not take: registers, and the Modbus exception with which it answers when they
/// are written. Aligned as large as it is, so that a processor reads and writes it at once.
struct alignas(8) WriteRefusal {
  std::uint32_t exception = 0;  // 0: nothing is refused
  std::uint16_t first = 0;      // address of the first register
  std::uint16_t count = 0;

  bool any() const noexcept { return exception != 0; }
};

/// How the peer packs messages into registers, where their check sums say that it is otherwise than
/// in the layout. Aligned as large as it is, as WriteRefusal.
struct alignas(8) RegisterPacking {
  enum class Words : std::uint8_t {
    kAsLaidOut,
    kAll,     // the two registers of each value and of the check sum are swapped
    kValues,  // those of the values only
  } words = Words::kAsLaidOut;
  bool bytes_swapped = false;  // of each register
  std::int8_t shift = 0;       // registers by which messages stand too far on
  /// Whether the check sum was formed of what was sent, or before it was swapped or shifted.
  enum class Sum : std::uint8_t { kAsSent, kAsLaidOut };
  Sum sum_content = Sum::kAsSent, sum_address = Sum::kAsSent;
  MessageKind kind = MessageKind::kJoints;  // one of the messages that are packed so
  bool alone = false;                       // there are others, which are as in the layout

  /// Otherwise than in the layout.
  bool any() const noexcept { return words != Words::kAsLaidOut || bytes_swapped || shift != 0; }
  bool operator==(const RegisterPacking&) const = default;
};

enum class LinkState : std::uint8_t {
  kUp,
  kDegraded,  // up, but the bus controller reports errors (warning, passive)
  kDown,      // no cable, bus off, interface down or peer gone; the link recovers by itself
};

/// A bus as the thread of the cycle sees it, independent of its kind.
///
/// receive() and send() never block, never allocate and take no lock; they return at once if there
/// is nothing to receive or no room to send. Thread: one.
class BusPort {
 public:
  virtual ~BusPort() = default;

  /// The next received message, in the order of arrival. False: there is none.
  virtual bool receive(BusMessage& message) noexcept = 0;

  /// False: not sent, and counted as such. Nothing is queued except by the link itself.
  virtual bool send(const BusMessage& message) noexcept = 0;

  virtual LinkState state() const noexcept = 0;
  virtual PortCounters counters() const noexcept = 0;

  /// What the peer has refused to take for longer than a moment; nothing on a bus where nobody can.
  virtual WriteRefusal refusal() const noexcept { return {}; }

  /// How the peer packs its messages, if that is known to be otherwise than in the layout.
  virtual RegisterPacking packing() const noexcept { return {}; }
};

}  // namespace plumb::drivers
