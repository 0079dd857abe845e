// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "plumb/drivers/bus_port.hpp"

namespace plumb::drivers {

/// What the controller of the bus and the kernel told. All monotone.
struct CanErrorCounters {
  std::uint64_t warnings = 0;          // error counter of the controller at 96 or more
  std::uint64_t passives = 0;          // at 128 or more: it signals errors no longer
  std::uint64_t bus_offs = 0;          // at 256: it takes no part
  std::uint64_t restarts = 0;          // back after bus-off
  std::uint64_t arbitration_lost = 0;  // someone with a lower identifier went first
  std::uint64_t transmit_timeouts = 0;
  std::uint64_t not_acknowledged = 0;    // alone on the bus, or the cable is off
  std::uint64_t controller_overran = 0;  // frames lost before the kernel saw them
  std::uint64_t interface_downs = 0;
};

/// Whether the bus can be used, from error frames and failed system calls.
///
///     down   interface down or gone, until a frame goes or comes
///            bus-off, until a restart, error-active, or a frame from the wire
///            a full queue while error-passive (no one acknowledges), until a frame goes
///     degraded   error-warning or error-passive, until error-active
class CanCondition {
 public:
  /// An error frame of linux/can/error.h: its identifier without flags, and its 8 bytes.
  void hear(std::uint32_t classes, const std::array<std::uint8_t, 8>& data) noexcept;

  void interface_down(std::int64_t now_ns) noexcept;
  void sent() noexcept;
  void queue_full() noexcept;
  void carrier_back() noexcept;

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
  std::int64_t down_since_ns_ = 0;
  std::uint64_t reconnects_ = 0;
  CanErrorCounters errors_;
};

}  // namespace plumb::drivers
