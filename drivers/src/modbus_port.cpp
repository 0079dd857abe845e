// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_port.hpp"

#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {

ModbusPort::ModbusPort(ModbusExchange& exchange, const BusLayout& layout, Sender self)
    : exchange_(&exchange) {
  for (const auto& message : layout.messages)
    if (message.sender == self) ours_[static_cast<std::size_t>(message.kind)] = true;
}

bool ModbusPort::receive(BusMessage& message) noexcept {
  for (std::size_t i = 0; i < kMessageKinds; ++i) {
    const std::size_t kind = turn_;
    turn_ = (turn_ + 1) % kMessageKinds;
    if (exchange_->from_peer[kind].take(message)) return true;
  }
  return false;
}

bool ModbusPort::send(const BusMessage& message) noexcept {
  const auto kind = static_cast<std::size_t>(message.kind);
  const bool known = kind < kMessageKinds && ours_[kind];
  if (known) {
    BusMessage stamped = message;
    stamped.time_ns = MonotonicTime::now_ns();
    exchange_->to_peer[kind].put(stamped);
  }
  const bool sent = known && state() != LinkState::kDown;
  if (!sent) ++exchange_->counters.not_sent;
  return sent;
}

LinkState ModbusPort::state() const noexcept {
  return exchange_->state.load(std::memory_order_relaxed);
}

PortCounters ModbusPort::counters() const noexcept {
  const ModbusCounters& link = exchange_->counters;
  PortCounters out;
  out.received = link.received;
  out.sent = link.sent;
  out.corrupt = link.corrupt + link.bad_frames;
  out.repeated = link.repeated;
  out.not_sent = link.not_sent + link.stale;
  out.reconnects = link.connects > 0 ? link.connects - 1 : 0;
  out.restarts = link.restarts;
  out.foreign_senders = link.foreign_senders;
  out.refused_writes = link.refused_writes;
  return out;
}

RegisterPacking ModbusPort::packing() const noexcept {
  return exchange_->packing.load(std::memory_order_relaxed);
}

WriteRefusal ModbusPort::refusal() const noexcept {
  return exchange_->refusal.load(std::memory_order_relaxed);
}

}  // namespace plumb::drivers
