// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/drivers/bus_content.hpp"

namespace plumb::drivers {

/// Watches the bit "acknowledge" of the controller for an operator who presses a button.
///
/// It acknowledges when it goes off after it was on for kHeld_ns without a gap, all the time while
/// an acknowledgement was asked for. So a single frame, a bit that a program toggles, one that is
/// stuck, and a button that was pressed before anybody asked acknowledge nothing. A gap is a
/// message with impossible values, or kGap_ns without a message.
///
/// Heap: none. Thread: one. Cost: fixed.
class AcknowledgeButton {
 public:
  /// Chosen: shorter than a person presses a button, and much longer than a disturbed bit lasts;
  /// the gap is as long as that message may be absent (InputSettings::limit_s).
  static constexpr std::int64_t kHeld_ns = 200'000'000, kGap_ns = 100'000'000;

  /// Takes a message of kind kController. Returns true if it acknowledges.
  bool hear(const BusMessage& message, bool asked) noexcept;

  /// What was pressed so far does not count; the bit must be seen off first.
  void forget() noexcept { press_ = Press::kVoid; }

 private:
  enum class Press : std::uint8_t {
    kVoid,  // unknown, or on since before it counted: it must be seen off first
    kOff,
    kOn,  // since begun_ns_
  } press_ = Press::kVoid;
  std::int64_t begun_ns_ = 0;
  std::int64_t heard_ns_ = 0;  // when the last message was received
};

}  // namespace plumb::drivers
