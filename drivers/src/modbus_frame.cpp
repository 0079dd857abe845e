// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_frame.hpp"

#include <cstring>

namespace plumb::drivers {
namespace {

constexpr std::size_t kBeforeUnit = kMbapHeader - 1;  // bytes that the length does not count

}  // namespace

void put_header(const MbapHeader& header, std::span<std::uint8_t> frame) noexcept {
  set_word(frame, 0, header.transaction);
  set_word(frame, 2, 0);
  set_word(frame, 4, static_cast<std::uint16_t>(header.pdu_size + 1));
  frame[kBeforeUnit] = header.unit;
}

void ModbusFramer::drop_taken() noexcept {
  used_ -= taken_;
  std::memmove(bytes_.data(), bytes_.data() + taken_, used_);
  taken_ = 0;
}

ModbusFramer::Cut ModbusFramer::next() noexcept {
  drop_taken();
  const std::span<const std::uint8_t> bytes(bytes_);
  if (used_ >= 4 && word_at(bytes, 2) != 0) return Cut::kBroken;
  if (used_ < kBeforeUnit) return Cut::kPart;
  const std::size_t length = word_at(bytes, 4);
  if (length < 2 || length > kMostPdu + 1) return Cut::kBroken;
  if (used_ < kBeforeUnit + length) return Cut::kPart;
  header_.transaction = word_at(bytes, 0);
  header_.unit = bytes_[kBeforeUnit];
  header_.pdu_size = static_cast<std::uint16_t>(length - 1);
  taken_ = kBeforeUnit + length;
  return Cut::kFrame;
}

}  // namespace plumb::drivers
