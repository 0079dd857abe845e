// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/runtime/age.hpp"

namespace plumb::drivers {

/// The last message of every kind, whether it is new in this cycle, and how old it is.
///
/// Ages count cycles as well as the clock: no jump of a clock makes a message young, and one that
/// waited in a queue is as old as its reception.
///
/// Heap: none. Thread: one. Cost: fixed.
class SessionInbox {
 public:
  void hear(const BusMessage& message) noexcept;

  /// Once a cycle, after the messages of it: by how much all grew older [s].
  void step(std::int64_t now_ns, double ageing_s) noexcept;

  /// After the cycle: nothing is new any more.
  void close() noexcept { came_.fill(false); }

  const BusMessage& last(MessageKind kind) const noexcept { return last_[at(kind)]; }
  bool came(MessageKind kind) const noexcept { return came_[at(kind)]; }
  double age_s(MessageKind kind) const noexcept { return age_[at(kind)].value_s(); }
  bool within(MessageKind kind, double limit_s) const noexcept {
    return age_[at(kind)].within(limit_s);
  }

 private:
  static constexpr std::size_t at(MessageKind kind) noexcept {
    return static_cast<std::size_t>(kind);
  }

  std::array<BusMessage, kMessageKinds> last_;
  std::array<bool, kMessageKinds> came_{};
  std::array<Age, kMessageKinds> age_;
};

}  // namespace plumb::drivers
