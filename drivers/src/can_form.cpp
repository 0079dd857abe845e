// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_form.hpp"

#include "fd_length.hpp"

namespace plumb::drivers {
namespace {

CanForm classic_form(std::size_t size, std::uint8_t values) {
  return {.frames = static_cast<std::uint8_t>((size + values - 1) / values),
          .values = values,
          .value_bytes = static_cast<std::uint8_t>(6 / values),
          .counter_byte = 6,
          .counter_bytes = 1,
          .check_byte = 7,
          .check_bytes = 1,
          .length = 8};
}

CanForm fd_form(std::size_t size) {
  const auto bytes = static_cast<std::uint8_t>(4 * size);
  return {.frames = 1,
          .values = static_cast<std::uint8_t>(size),
          .value_bytes = 4,
          .counter_byte = bytes,
          .counter_bytes = 2,
          .check_byte = static_cast<std::uint8_t>(bytes + 2),
          .check_bytes = 4,
          .length = fd_length(bytes + 6U)};
}

}  // namespace

CanForm can_form(const BusLayout& layout, const MessageLayout& message) {
  if (layout.can_format == CanFrame::Format::kFd) return fd_form(message.signals.size());
  return classic_form(message.signals.size(), message.kind == MessageKind::kOffset ? 3 : 2);
}

std::size_t can_frames(const BusLayout& layout, const MessageLayout& message) {
  return can_form(layout, message).frames;
}

}  // namespace plumb::drivers
