// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/cycle_clock.hpp"
#include "plumb/drivers/event_ring.hpp"
#include "plumb/drivers/mailbox.hpp"
#include "plumb/drivers/record_ring.hpp"
#include "plumb/drivers/session_copy.hpp"

namespace plumb::drivers {

/// The state of a run as the cycle's thread last published it.
struct RunSnapshot {
  std::int64_t now_ns = 0;
  SessionReport session;
  PortCounters port;
  LinkState link = LinkState::kDown;
  WriteRefusal refusal;
  RegisterPacking packing;
  ClockCounters clock;
  LatencyHistogram wake;  // delays of the beginning of a cycle
  LatencyHistogram work;  // durations of a cycle
  std::uint32_t model = 0;
};

/// The data that the cycle's thread shares with others. All of it is wait-free.
struct RunShared {
  EventRing events;
  Mailbox<RunSnapshot> snapshots;
  RecordRing record;
  std::atomic<std::uint64_t> beats{0};  // completed cycles; a watchdog checks that it grows
  std::atomic<bool> stop{false};        // request to ramp out and end
  SessionCopy copy;                     // for the record
};

}  // namespace plumb::drivers
