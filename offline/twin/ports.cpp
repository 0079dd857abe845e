// SPDX-License-Identifier: Apache-2.0
#include "twin/ports.hpp"

namespace plumb::offline::twin {
namespace {

using drivers::BusMessage;
using drivers::CanFrame;

bool flip_a_bit(CanFrame& frame, sim::Random& random) {
  if (frame.length == 0) return true;
  const int bit = random.below(8 * frame.length);
  frame.data[static_cast<std::size_t>(bit / 8)] ^= static_cast<std::uint8_t>(1U << (bit % 8));
  return true;
}

bool lost(BusMessage&, sim::Random&) { return false; }

}  // namespace

FaultyCanPort::FaultyCanPort(CanWire& wire, const drivers::BusLayout& layout, const FaultPlan& plan,
                             const TwinTime& time, std::uint64_t seed)
    : wire_(wire),
      time_(time),
      codec_(layout),
      out_(plan, seed, "line out", flip_a_bit),
      in_(plan, seed, "line in", flip_a_bit) {}

void FaultyCanPort::flush() noexcept {
  CanFrame frame;
  while (out_.get(frame, time_.now_ns))
    if (!wire_.write(frame)) ++counters_.not_sent;
}

bool FaultyCanPort::send(const BusMessage& message) noexcept {
  flush();
  const auto frames = codec_.encode(message);
  for (const CanFrame& frame : frames) out_.put(frame, time_.now_ns, time_.path_s);
  flush();
  if (!frames.empty()) ++counters_.sent;
  return !frames.empty();
}

bool FaultyCanPort::receive(BusMessage& message) noexcept {
  flush();
  CanFrame frame;
  while (wire_.read(frame)) in_.put(frame, time_.now_ns, time_.path_s);
  while (in_.get(frame, time_.now_ns)) {
    frame.time_ns = time_.now_ns;
    switch (codec_.hear(frame, message)) {
      case drivers::Heard::kComplete:
        ++counters_.received;
        return true;
      case drivers::Heard::kCorrupt:
        ++counters_.corrupt;
        break;
      case drivers::Heard::kRepeated:
        ++counters_.repeated;
        break;
      default:
        break;
    }
  }
  counters_.skipped = codec_.skipped();
  return false;
}

FaultyPort::FaultyPort(drivers::BusPort& port, const FaultPlan& plan, const TwinTime& time,
                       std::uint64_t seed)
    : port_(port),
      time_(time),
      out_(plan, seed, "line out", lost),
      in_(plan, seed, "line in", lost) {}

bool FaultyPort::send(const BusMessage& message) noexcept {
  out_.put(message, time_.now_ns, time_.path_s);
  bool sent = true;
  BusMessage due;
  while (out_.get(due, time_.now_ns)) sent = port_.send(due) && sent;
  return sent;
}

bool FaultyPort::receive(BusMessage& message) noexcept {
  BusMessage due;
  while (out_.get(due, time_.now_ns)) (void)port_.send(due);
  while (port_.receive(due)) in_.put(due, time_.now_ns, time_.path_s);
  if (!in_.get(message, time_.now_ns)) return false;
  message.time_ns = time_.now_ns;
  return true;
}

bool MemoryBus::End::receive(BusMessage& message) noexcept {
  if (in_.empty()) return false;
  message = in_.front();
  in_.pop_front();
  message.time_ns = time_.now_ns;
  ++counters_.received;
  return true;
}

bool MemoryBus::End::send(const BusMessage& message) noexcept {
  if (bus_.down_) {
    ++counters_.not_sent;
    return false;
  }
  out_.push_back(message);
  ++counters_.sent;
  return true;
}

}  // namespace plumb::offline::twin
