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

/// A counter that one thread increments and any thread may read.
class Count {
 public:
  void operator++() noexcept {
    value_.store(value_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  operator std::uint64_t() const noexcept { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> value_{0};
};

/// Counters of a Modbus link, which only grow. The link's thread counts all of them except
/// `not_sent`.
struct ModbusCounters {
  Count received;         // valid messages
  Count sent;             // client: written and confirmed; server: read by the peer at least once
  Count corrupt;          // blocks with a wrong checksum
  Count repeated;         // server: a block was written again with the same counter
  Count stale;            // messages of the cycle dropped because they had waited too long
  Count not_sent;         // counted by the cycle's thread: there was no peer
  Count transactions;     // requests that were answered correctly
  Count refusals;         // exception answers: received by a client, sent by a server
  Count refused_writes;   // client: writes that were answered with an exception
  Count timeouts;         // client: no complete answer in time; server: no complete request
  Count bad_frames;       // answers or requests with a wrong form
  Count connects;         // client: connections made (serial: answered); server: accepted
  Count disconnects;      // connections closed, for whatever reason
  Count foreign_peers;    // server: connections refused by the allow-list
  Count crowded_out;      // server: connections refused because there were too many
  Count restarts;         // client: our registers were zeroed or reset, as by a controller that
                          // was started again
  Count foreign_senders;  // client: our registers contained what we did not write; server: a
                          // second connection wrote to the controller's registers
};

/// The data shared by the cycle's thread and the thread of a Modbus link: one mailbox per message
/// and direction, the state of the link and its counters.
struct ModbusExchange {
  using Mailboxes = std::array<Mailbox<BusMessage>, kMessageKinds>;
  Mailboxes from_peer;  // filled by the link's thread, emptied by the cycle's
  Mailboxes to_peer;    // filled by the cycle's thread, emptied by the link's
  std::atomic<LinkState> state{LinkState::kDown};
  std::atomic<WriteRefusal> refusal{WriteRefusal{}};
  static_assert(std::atomic<WriteRefusal>::is_always_lock_free);
  std::atomic<RegisterPacking> packing{RegisterPacking{}};
  static_assert(std::atomic<RegisterPacking>::is_always_lock_free);
  ModbusCounters counters;
};

}  // namespace plumb::drivers
