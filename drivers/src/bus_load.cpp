// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "plumb/drivers/can_form.hpp"

namespace plumb::drivers {
namespace {

/// The largest number of stuff bits in n bits: the first takes five equal bits and every further
/// one four, floor((n - 1) / 4).
double stuff_bits(std::size_t bits) { return std::floor((static_cast<double>(bits) - 1.0) / 4.0); }

/// Bits = 8 n + 44 + floor((34 + 8 n - 1) / 4) + 3, extended 8 n + 64 + floor((54 + 8 n - 1) / 4)
/// + 3: start to CRC is stuffed (34 or 54 bits besides the data), then 10 bits to the end of the
/// frame and 3 between frames. [Davis et al. 2007, "Controller Area Network (CAN) schedulability
/// analysis", eq. (1); 135 and 160 bits at n = 8]
FrameBits classic_bits(CanFrame::Id id_kind, std::size_t n) {
  const std::size_t stuffed = (id_kind == CanFrame::Id::kStandard ? 34 : 54) + 8 * n;
  return {.slow = static_cast<double>(stuffed) + stuff_bits(stuffed) + 13.0, .fast = 0.0};
}

/// ISO 11898-1:2015. At the bit rate of the arbitration: start to bit rate switch (17 or 36 bits,
/// stuffed), then CRC delimiter, acknowledgement 2, end 7, between frames 3. At the data bit rate:
/// error state, length code 4, data (stuffed), then stuff count 4, CRC 17 or (n > 16) 21 and a
/// fixed stuff bit before every four of them. The number of stuff bits is the largest that all
/// stuffed bits together allow; those in the arbitration phase are counted at its rate.
FrameBits fd_bits(CanFrame::Id id_kind, std::size_t n) {
  const std::size_t head = id_kind == CanFrame::Id::kStandard ? 17 : 36;
  const std::size_t body = 5 + 8 * n;
  const double check = n > 16 ? 4.0 + 21.0 + 7.0 : 4.0 + 17.0 + 6.0;
  return {.slow = static_cast<double>(head) + stuff_bits(head) + 13.0,
          .fast = static_cast<double>(body) + stuff_bits(head + body) - stuff_bits(head) + check};
}

}  // namespace

FrameBits worst_frame_bits(CanFrame::Format format, CanFrame::Id id_kind, std::size_t length) {
  return format == CanFrame::Format::kFd ? fd_bits(id_kind, length) : classic_bits(id_kind, length);
}

double worst_bus_load(const BusLayout& layout) {
  double load = 0.0;
  for (const MessageLayout& message : layout.messages) {
    const CanForm form = can_form(layout, message);
    const FrameBits bits = worst_frame_bits(layout.can_format, layout.id_kind, form.length);
    const double frame_s = bits.slow / layout.bit_rate + bits.fast / layout.data_bit_rate;
    load += form.frames * frame_s / message.period_s;
  }
  return load;
}

}  // namespace plumb::drivers
