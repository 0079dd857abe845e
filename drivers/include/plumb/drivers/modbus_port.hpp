// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/modbus_exchange.hpp"

namespace plumb::drivers {

/// The cycle's end of a Modbus link, client or server, for plumb-rt or for a controller.
///
/// Only the newest message of a kind is kept, both ways. receive() gives the kinds in turn.
/// send() leaves the message with the link's thread; false: there is no peer now. Should one come
/// before the message is stale (settings of the link), it still gets it.
///
/// Wait-free; no allocation; the only call is a read of the clock. Thread: one.
class ModbusPort final : public BusPort {
 public:
  /// `exchange`: of a ModbusClient or ModbusServer that lives longer. `self`: who we are; messages
  /// of the other side are not sent.
  ModbusPort(ModbusExchange& exchange, const BusLayout& layout, Sender self);

  bool receive(BusMessage& message) noexcept override;
  bool send(const BusMessage& message) noexcept override;
  LinkState state() const noexcept override;
  PortCounters counters() const noexcept override;

 private:
  ModbusExchange* exchange_;
  std::array<bool, kMessageKinds> ours_{};
  std::size_t turn_ = 0;
};

}  // namespace plumb::drivers
