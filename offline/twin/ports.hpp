// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>

#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/can_codec.hpp"
#include "twin/faulty_line.hpp"
#include "twin/twin_time.hpp"

namespace plumb::offline::twin {

/// Transmits CAN frames: over an interface, or in memory for tests. No function blocks.
class CanWire {
 public:
  virtual ~CanWire() = default;
  virtual bool write(const drivers::CanFrame& frame) noexcept = 0;
  virtual bool read(drivers::CanFrame& frame) noexcept = 0;
  virtual drivers::LinkState state() const noexcept = 0;
};

/// The controller's end of a CAN bus, with faults between codec and wire, so that corrupt, lost and
/// late frames are handled by the checks of the receiver. `time` and `plan` must outlive it.
class FaultyCanPort final : public drivers::BusPort {
 public:
  FaultyCanPort(CanWire& wire, const drivers::BusLayout& layout, const FaultPlan& plan,
                const TwinTime& time, std::uint64_t seed);

  bool receive(drivers::BusMessage& message) noexcept override;
  bool send(const drivers::BusMessage& message) noexcept override;
  drivers::LinkState state() const noexcept override { return wire_.state(); }
  drivers::PortCounters counters() const noexcept override { return counters_; }

 private:
  void flush() noexcept;

  CanWire& wire_;
  const TwinTime& time_;
  drivers::CanCodec codec_;
  FaultyLine<drivers::CanFrame> out_, in_;
  drivers::PortCounters counters_;
};

/// The same for any other port. The faults act on whole messages, and a corrupt message is lost,
/// because the receiver would discard it for its check sum.
class FaultyPort final : public drivers::BusPort {
 public:
  FaultyPort(drivers::BusPort& port, const FaultPlan& plan, const TwinTime& time,
             std::uint64_t seed);

  bool receive(drivers::BusMessage& message) noexcept override;
  bool send(const drivers::BusMessage& message) noexcept override;
  drivers::LinkState state() const noexcept override { return port_.state(); }
  drivers::PortCounters counters() const noexcept override { return port_.counters(); }

 private:
  drivers::BusPort& port_;
  const TwinTime& time_;
  FaultyLine<drivers::BusMessage> out_, in_;
};

/// Two connected ports in memory, for tests: each receives what the other sends.
class MemoryBus {
 public:
  explicit MemoryBus(const TwinTime& time) : a_(*this, ab_, ba_, time), b_(*this, ba_, ab_, time) {}
  MemoryBus(const MemoryBus&) = delete;
  MemoryBus& operator=(const MemoryBus&) = delete;

  drivers::BusPort& a() { return a_; }
  drivers::BusPort& b() { return b_; }
  void cut(bool down) { down_ = down; }

 private:
  using Queue = std::deque<drivers::BusMessage>;
  class End final : public drivers::BusPort {
   public:
    End(const MemoryBus& bus, Queue& out, Queue& in, const TwinTime& time)
        : bus_(bus), out_(out), in_(in), time_(time) {}
    bool receive(drivers::BusMessage& message) noexcept override;
    bool send(const drivers::BusMessage& message) noexcept override;
    drivers::LinkState state() const noexcept override {
      return bus_.down_ ? drivers::LinkState::kDown : drivers::LinkState::kUp;
    }
    drivers::PortCounters counters() const noexcept override { return counters_; }

   private:
    const MemoryBus& bus_;
    Queue& out_;
    Queue& in_;
    const TwinTime& time_;
    drivers::PortCounters counters_;
  };

  bool down_ = false;
  Queue ab_, ba_;
  End a_, b_;
};

}  // namespace plumb::offline::twin
