// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_message.hpp"
#include "plumb/drivers/can_frame.hpp"

namespace plumb::drivers {

inline constexpr std::size_t kMaxCanFrames = 6;  // of one message

/// What a frame was worth.
enum class Heard : std::uint8_t {
  kNotOurs,   // no identifier of the layout
  kPart,      // of a message that is not complete yet
  kComplete,  // the message is in `out`
  kRepeated,  // a counter that was complete before
  kCorrupt,   // check sum, length, format or a value that cannot be
};

/// Messages to frames and back, by the layout.
///
/// A message of several frames counts once all of them carry one counter; a frame of another
/// counter begins anew. Every frame carries a counter and a check sum that covers its identifier.
///
/// Heap: only in the constructor. Thread: one. Cost: fixed. Errors: by value.
class CanCodec {
 public:
  /// Copies what it needs. The layout has no faults (find_faults).
  explicit CanCodec(const BusLayout& layout);

  /// The frames of `message`, in the order to send them; none if the layout has no such message.
  /// Values beyond the range of the wire saturate; NaN has a code of its own.
  std::span<const CanFrame> encode(const BusMessage& message) noexcept;

  /// Takes one frame that came.
  Heard hear(const CanFrame& frame, BusMessage& out) noexcept;

  /// Counters that never came, and messages begun but not completed.
  std::uint64_t skipped() const noexcept { return skipped_; }
  std::uint64_t incomplete() const noexcept { return incomplete_; }

 private:
  // to be settled by the implementation
  std::uint64_t skipped_ = 0;
  std::uint64_t incomplete_ = 0;
};

}  // namespace plumb::drivers
