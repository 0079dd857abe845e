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

inline constexpr std::size_t kMaxCanFrames = 7;  // per message

/// The result of decoding a frame or a block of registers.
enum class Heard : std::uint8_t {
  kNotOurs,   // the identifier is not in the layout
  kPart,      // part of a message that is not complete yet
  kComplete,  // the message is complete and in `out`
  kRepeated,  // its counter was complete before or was overtaken, or this part is known already
  kCorrupt,   // the checksum, length, format or padding is wrong
  kNothing,   // Modbus: the sender left no message in the block
};

/// Converts messages to CAN frames and back, according to the layout.
///
/// A message of several frames is complete when all of them have arrived with the same counter; a
/// frame with another counter begins a new message. Every frame carries a counter and a checksum
/// that covers its identifier.
///
/// Counters count the cycles of the sender. A frame whose counter lies less than kOvertaken behind
/// the last complete message, or behind the one begun, and that arrives within as many cycles, was
/// overtaken on its way and is kRepeated. Any other counter is new, so that a sender may restart.
/// The parts of a message wait for each other for at most half a round of the counter, because
/// after that the same counter may belong to another cycle.
///
/// Heap: only in the constructor. Thread: one. Cost: fixed. Errors: by value.
class CanCodec {
 public:
  static constexpr int kOvertaken = 32;  // cycles

  /// Copies what it needs. Precondition: find_faults finds none in the layout.
  explicit CanCodec(const BusLayout& layout);

  /// The frames of `message`, in the order of sending; none if the layout has no such message.
  /// Values beyond the range of the wire saturate; NaN has its own code. The frames are valid until
  /// the next call.
  std::span<const CanFrame> encode(const BusMessage& message) noexcept;

  /// Decodes one received frame. A message gets the time of its earliest frame.
  Heard hear(const CanFrame& frame, BusMessage& out) noexcept;

  /// Number of counters never received, and of messages begun but not completed.
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

    std::uint32_t parts = 0;  // bit i: frame i of message `counter` has arrived
    std::uint16_t counter = 0;
    std::int64_t begun_ns = 0;
    std::array<std::int32_t, kMaxMessageValues> counts{};

    bool heard = false;  // a complete message has arrived, the last one with counter `last`
    std::uint16_t last = 0;
    std::int64_t last_ns = 0;
  };
  struct Part {
    std::size_t index = 0;  // index of the frame in its message
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
