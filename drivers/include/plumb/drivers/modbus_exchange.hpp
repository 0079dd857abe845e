// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_message.hpp"
#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/mailbox.hpp"

namespace plumb::drivers {

/// A counter that one thread counts and any thread reads.
class Count {
 public:
  void operator++() noexcept {
    value_.store(value_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  operator std::uint64_t() const noexcept { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> value_{0};
};

/// Counters of a Modbus link. All monotone; counted by the link's thread, but `not_sent`.
struct ModbusCounters {
  Count received;         // sound messages
  Count sent;             // client: written and confirmed; server: read by the peer at least once
  Count corrupt;          // blocks whose check sum did not fit
  Count repeated;         // server: a block written again with the same counter
  Count stale;            // messages of the cycle dropped because they had waited too long
  Count not_sent;         // counted by the cycle's thread: there was no peer
  Count transactions;     // requests answered as they should be
  Count refusals;         // client: exception answers got; server: exception answers given
  Count timeouts;         // client: no whole answer in time; server: no whole request in time
  Count bad_frames;       // answers or requests that were not what they must be
  Count connects;         // client: connections made (serial: that were answered); server: taken
  Count disconnects;      // connections given up, whatever for
  Count foreign_peers;    // server: connections refused by the allow-list
  Count crowded_out;      // server: connections refused because there were too many
  Count foreign_senders;  // client: our registers held what we did not write; server: a second
                          // connection wrote the controller's registers
};

/// What the cycle's thread and a Modbus link's thread share: one mailbox a message and direction,
/// the link's state and its counters.
struct ModbusExchange {
  using Mailboxes = std::array<Mailbox<BusMessage>, kMessageKinds>;
  Mailboxes from_peer;  // put by the link's thread, taken by the cycle's
  Mailboxes to_peer;    // and back
  std::atomic<LinkState> state{LinkState::kDown};
  ModbusCounters counters;
};

}  // namespace plumb::drivers
