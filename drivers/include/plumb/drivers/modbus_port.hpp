// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/modbus_exchange.hpp"

namespace plumb::drivers {

/// The cycle's end of a Modbus link, which may be a client or a server, of plumb-rt or a
/// controller.
///
/// Only the newest message of each kind is kept, in both directions. receive() returns the kinds in
/// turn. send() hands the message to the link's thread. It returns false if there is no peer now; a
/// peer that connects before the message is stale (settings of the link) still receives it.
///
/// Wait-free, without allocation; the only system call is a read of the clock. Thread: one.
class ModbusPort final : public BusPort {
 public:
  /// `exchange`: of a ModbusClient or ModbusServer, which must outlive the port. `self`: our side;
  /// messages that belong to the other side are not sent.
  ModbusPort(ModbusExchange& exchange, const BusLayout& layout, Sender self);

  bool receive(BusMessage& message) noexcept override;
  bool send(const BusMessage& message) noexcept override;
  LinkState state() const noexcept override;
  PortCounters counters() const noexcept override;
  WriteRefusal refusal() const noexcept override;
  RegisterPacking packing() const noexcept override;

 private:
  ModbusExchange* exchange_;
  std::array<bool, kMessageKinds> ours_{};
  std::size_t turn_ = 0;
};

}  // namespace plumb::drivers
