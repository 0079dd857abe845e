// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "plumb/drivers/bus_port.hpp"

namespace plumb::drivers {

/// Counters of the errors that the bus controller and the kernel reported. They only grow.
struct CanErrorCounters {
  std::uint64_t warnings = 0;          // the controller's error counter reached 96
  std::uint64_t passives = 0;          // it reached 128: the controller no longer signals errors
  std::uint64_t bus_offs = 0;          // it reached 256: the controller left the bus
  std::uint64_t restarts = 0;          // the controller returned after bus-off
  std::uint64_t arbitration_lost = 0;  // a frame with a lower identifier was sent first
  std::uint64_t transmit_timeouts = 0;
  std::uint64_t not_acknowledged = 0;    // no one else is on the bus, or the cable is off
  std::uint64_t controller_overran = 0;  // frames lost before the kernel received them
  std::uint64_t interface_downs = 0;
};

/// Decides from error frames and failed system calls whether the bus can be used.
///
///     state      cause                                      until
///     down       the interface is down or gone              a frame is sent or received
///                bus-off                                    a restart, error-active, a frame
///                                                           from the wire, or the carrier is back
///                the queue is full while error-passive,     a frame is sent
///                that is, no one acknowledges
///     degraded   error-warning or error-passive             error-active
class CanCondition {
 public:
  /// Takes an error frame (linux/can/error.h): its identifier without flags, its 8 bytes, and when
  /// it came.
  void hear(std::uint32_t classes, const std::array<std::uint8_t, 8>& data,
            std::int64_t time_ns) noexcept;

  void interface_down(std::int64_t now_ns) noexcept;
  void sent() noexcept;
  void queue_full() noexcept;
  /// Takes whether the kernel says that there is a carrier, asked while bus-off. A carrier ends
  /// bus-off only after it was seen lost, or two seconds later, because the kernel tells of a lost
  /// carrier late.
  void carrier(bool there, std::int64_t now_ns) noexcept;

  enum class From : std::uint8_t { kWire, kThisMachine };
  void received(From from, std::int64_t time_ns) noexcept;

  bool bus_off() const noexcept { return bus_off_; }
  LinkState state() const noexcept;
  const CanErrorCounters& errors() const noexcept { return errors_; }
  std::uint64_t reconnects() const noexcept { return reconnects_; }

 private:
  enum class Confinement : std::uint8_t { kActive, kWarning, kPassive };  // ISO 11898-1

  bool down() const noexcept { return interface_down_ || bus_off_ || stuck_; }
  void hear_controller(std::uint8_t status) noexcept;
  void come_up() noexcept;
  template <class F>
  void change(F what) noexcept;

  bool interface_down_ = false;
  bool bus_off_ = false;
  bool stuck_ = false;
  Confinement confinement_ = Confinement::kActive;
  bool carrier_was_lost_ = false;  // since bus-off
  std::int64_t down_since_ns_ = 0;
  std::int64_t bus_off_since_ns_ = 0;
  std::uint64_t reconnects_ = 0;
  CanErrorCounters errors_;
};

}  // namespace plumb::drivers
