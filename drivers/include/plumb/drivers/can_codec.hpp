// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_message.hpp"
#include "plumb/drivers/can_form.hpp"
#include "plumb/drivers/can_frame.hpp"

namespace plumb::drivers {

inline constexpr std::size_t kMaxCanFrames = 7;  // of one message

/// What a frame was worth.
enum class Heard : std::uint8_t {
  kNotOurs,   // no identifier of the layout
  kPart,      // of a message that is not complete yet
  kComplete,  // the message is in `out`
  kRepeated,  // a counter that was complete before or overtaken, or a part that is there already
  kCorrupt,   // check sum, length, format or padding
  kNothing,   // Modbus: the block holds no message, as its owner left it
};

/// Messages to frames and back, by the layout.
///
/// A message of several frames counts once all of them carry one counter; a frame of another
/// counter begins anew. Every frame carries a counter and a check sum that covers its identifier.
///
/// Counters run in cycles. One that lies less than kOvertaken behind the last complete message, or
/// the one begun, and comes within that many cycles, was overtaken on its way: kRepeated. Any other
/// is new, so a sender that restarts is heard. Parts wait for the others for half a round of the
/// counter at most: beyond, the same counter means another cycle.
///
/// Heap: only in the constructor. Thread: one. Cost: fixed. Errors: by value.
class CanCodec {
 public:
  static constexpr int kOvertaken = 32;  // cycles

  /// Copies what it needs. The layout has no faults (find_faults).
  explicit CanCodec(const BusLayout& layout);

  /// The frames of `message`, in the order to send them; none if the layout has no such message.
  /// Values beyond the range of the wire saturate; NaN has a code of its own. Valid until the next
  /// call.
  std::span<const CanFrame> encode(const BusMessage& message) noexcept;

  /// Takes one frame that came. A message has the time of its earliest frame.
  Heard hear(const CanFrame& frame, BusMessage& out) noexcept;

  /// Counters that never came, and messages begun but not completed.
  std::uint64_t skipped() const noexcept { return skipped_; }
  std::uint64_t incomplete() const noexcept { return incomplete_; }

 private:
  struct Known {
    MessageKind kind = MessageKind::kJoints;
    std::uint8_t size = 0;
    std::uint32_t first_id = 0;
    CanForm form;
    std::array<double, kMaxMessageValues> scale{};
    int step = 1;  // cycles from one message to the next

    std::uint32_t parts = 0;  // bit i: frame i is there, of `counter`
    std::uint16_t counter = 0;
    std::int64_t begun_ns = 0;
    std::array<std::int32_t, kMaxMessageValues> counts{};

    bool heard = false;  // a complete message, of counter `last`
    std::uint16_t last = 0;
    std::int64_t last_ns = 0;
  };
  struct Part {
    std::size_t index = 0;  // of the frame in its message
    std::uint16_t counter = 0;
    std::int64_t time_ns = 0;
    std::array<std::int32_t, kMaxMessageValues> counts{};
  };

  Known* known(std::uint32_t id) noexcept;
  bool sound(const CanFrame& frame, const CanForm& form) const noexcept;
  bool read(const CanFrame& frame, const Known& known, Part& out) const noexcept;
  Heard collect(Known& known, const Part& part, BusMessage& out) noexcept;
  bool overtaken(const Known& known, const Part& part) const noexcept;
  Heard complete(Known& known, BusMessage& out) noexcept;
  void count_skipped(const Known& known) noexcept;
  void write(const BusMessage& message, const Known& known, CanFrame& frame) const noexcept;

  CanFrame::Format format_;
  CanFrame::Id id_kind_;
  ByteOrder order_;
  std::int64_t cycle_ns_ = 0;
  std::vector<Known> known_;
  std::array<CanFrame, kMaxCanFrames> frames_{};
  std::uint64_t skipped_ = 0;
  std::uint64_t incomplete_ = 0;
};

}  // namespace plumb::drivers
