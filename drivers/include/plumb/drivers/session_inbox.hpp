// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/runtime/detail/age.hpp"

namespace plumb::drivers {

/// Keeps the last message of every kind, whether it is new in this cycle, and its age.
///
/// An age grows in every cycle, so a jump of the clock cannot make a message younger. A message
/// that waited in a queue is aged from its reception.
///
/// Heap: none. Thread: one. Cost: fixed.
class SessionInbox {
 public:
  void hear(const BusMessage& message) noexcept;

  /// To be called once a cycle, after its messages: lets all messages grow older by ageing_s [s].
  void step(std::int64_t now_ns, double ageing_s) noexcept;

  /// To be called after the cycle: no message counts as new any more.
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
