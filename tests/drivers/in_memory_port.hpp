// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plumb/drivers/bus_port.hpp"

namespace plumb::tests {

/// A bus of two queues, which a test fills and reads. What is sent is kept in memory that was
/// there before, so that a test may count allocations.
class InMemoryPort final : public drivers::BusPort {
 public:
  InMemoryPort() {
    coming.reserve(kRoom);
    sent.reserve(kRoom);
  }

  bool receive(drivers::BusMessage& message) noexcept override {
    if (next_ == coming.size()) {
      coming.clear();
      next_ = 0;
      return false;
    }
    message = coming[next_++];
    ++counted.received;
    return true;
  }
  bool send(const drivers::BusMessage& message) noexcept override {
    const bool room = link != drivers::LinkState::kDown && sent.size() < kRoom;
    if (room) sent.push_back(message);
    ++(room ? counted.sent : counted.not_sent);
    return room;
  }
  drivers::LinkState state() const noexcept override { return link; }
  drivers::PortCounters counters() const noexcept override { return counted; }

  std::vector<drivers::BusMessage> coming;
  std::vector<drivers::BusMessage> sent;
  drivers::PortCounters counted;
  drivers::LinkState link = drivers::LinkState::kUp;

 private:
  static constexpr std::size_t kRoom = 4096;
  std::size_t next_ = 0;
};

}  // namespace plumb::tests
