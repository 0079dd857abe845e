// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/cycle_clock.hpp"
#include "plumb/drivers/mailbox.hpp"
#include "rt/record_ring.hpp"

namespace plumb::drivers::rt {

/// How a run stands, as the cycle's thread last said.
struct RunSnapshot {
  std::int64_t now_ns = 0;
  SessionReport session;
  PortCounters port;
  LinkState link = LinkState::kDown;
  ClockCounters clock;
  LatencyHistogram wake;  // how late the cycle began
  LatencyHistogram work;  // how long it took
  std::uint32_t model = 0;
};

/// All that the cycle's thread shares with the others. Nothing in it waits.
struct RunShared {
  Mailbox<RunSnapshot> snapshots;
  RecordRing record;
  std::atomic<bool> stop{false};        // ramp out and end
  std::atomic<std::uint64_t> beats{0};  // cycles done: the watchdog looks whether it goes on
};

}  // namespace plumb::drivers::rt
