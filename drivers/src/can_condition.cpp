// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_condition.hpp"

#include <linux/can/error.h>

namespace plumb::drivers {
namespace {

constexpr std::uint8_t kWarned = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;
constexpr std::uint8_t kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
constexpr std::uint8_t kActive = CAN_ERR_CRTL_ACTIVE;
constexpr std::uint8_t kOverran = CAN_ERR_CRTL_RX_OVERFLOW;

/// Linux tells of a lost carrier up to a second late, if another link changed just before.
constexpr std::int64_t kCarrierToldAfterNs = 2'000'000'000;

}  // namespace

template <class F>
void CanCondition::change(F what) noexcept {
  const bool was_down = down();
  what();
  if (was_down && !down()) ++reconnects_;
}

void CanCondition::hear_controller(std::uint8_t status) noexcept {
  if (status & kOverran) ++errors_.controller_overran;
  if (status & kPassive) {
    ++errors_.passives;
    confinement_ = Confinement::kPassive;
  } else if (status & kWarned) {
    ++errors_.warnings;
    confinement_ = Confinement::kWarning;
    stuck_ = false;
  } else if (status & kActive) {
    confinement_ = Confinement::kActive;
    bus_off_ = stuck_ = false;
  }
}

void CanCondition::hear(std::uint32_t classes, const std::array<std::uint8_t, 8>& data,
                        std::int64_t time_ns) noexcept {
  if (classes & CAN_ERR_TX_TIMEOUT) ++errors_.transmit_timeouts;
  if (classes & CAN_ERR_LOSTARB) ++errors_.arbitration_lost;
  if (classes & CAN_ERR_ACK) ++errors_.not_acknowledged;
  change([&] {
    if (classes & CAN_ERR_CRTL) hear_controller(data[1]);
    if (classes & CAN_ERR_RESTARTED) {
      ++errors_.restarts;
      confinement_ = Confinement::kActive;
      bus_off_ = stuck_ = false;
    }
    if (classes & CAN_ERR_BUSOFF) {
      ++errors_.bus_offs;
      bus_off_ = true;
      bus_off_since_ns_ = time_ns;
      carrier_was_lost_ = false;
    }
  });
}

void CanCondition::interface_down(std::int64_t now_ns) noexcept {
  if (!interface_down_) ++errors_.interface_downs;
  interface_down_ = carrier_was_lost_ = true;
  down_since_ns_ = now_ns;
}

/// An interface that comes up again starts with a CAN controller without errors.
void CanCondition::come_up() noexcept {
  interface_down_ = bus_off_ = false;
  confinement_ = Confinement::kActive;
}

void CanCondition::sent() noexcept {
  change([&] {
    if (interface_down_) come_up();
    stuck_ = false;
  });
}

void CanCondition::queue_full() noexcept {
  if (confinement_ == Confinement::kPassive) stuck_ = true;
}

void CanCondition::carrier(bool there, std::int64_t now_ns) noexcept {
  if (!there) carrier_was_lost_ = true;
  const bool is_told = carrier_was_lost_ || now_ns - bus_off_since_ns_ > kCarrierToldAfterNs;
  if (there && is_told) change([&] { bus_off_ = false; });
}

void CanCondition::received(From from, std::int64_t time_ns) noexcept {
  change([&] {
    if (interface_down_ && time_ns > down_since_ns_) come_up();
    if (from == From::kWire) bus_off_ = false;
  });
}

LinkState CanCondition::state() const noexcept {
  if (down()) return LinkState::kDown;
  return confinement_ == Confinement::kActive ? LinkState::kUp : LinkState::kDegraded;
}

}  // namespace plumb::drivers
