// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/drivers/bus_message.hpp"

namespace plumb::drivers {

/// How a link is doing, as its counters say. All monotone.
struct PortCounters {
  std::uint64_t received = 0;  // complete, sound messages
  std::uint64_t sent = 0;
  std::uint64_t corrupt = 0;     // a check sum, length or range was wrong
  std::uint64_t repeated = 0;    // the same counter again
  std::uint64_t skipped = 0;     // counters that never came
  std::uint64_t overflowed = 0;  // lost in our own receive queue
  std::uint64_t not_sent = 0;    // the transmit queue was full or the link down
  std::uint64_t reconnects = 0;
  std::uint64_t foreign_senders = 0;  // our own identifier, sent by someone else
};

enum class LinkState : std::uint8_t {
  kUp,
  kDegraded,  // up, but the controller of the bus reports errors (warning, passive)
  kDown,      // no cable, bus off, interface down, peer gone: the link tries to come back by itself
};

/// What the cycle's thread sees of a bus, whatever the bus is.
///
/// receive() and send() never block, never allocate, take no lock and return at once when there is
/// nothing, or no room. Thread: one.
class BusPort {
 public:
  virtual ~BusPort() = default;

  /// The next message that came, in the order of arrival; false: none.
  virtual bool receive(BusMessage& message) noexcept = 0;

  /// False: not sent, and counted. Nothing is queued beyond what the link itself holds.
  virtual bool send(const BusMessage& message) noexcept = 0;

  virtual LinkState state() const noexcept = 0;
  virtual PortCounters counters() const noexcept = 0;
};

}  // namespace plumb::drivers
