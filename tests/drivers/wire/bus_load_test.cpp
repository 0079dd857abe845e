// SPDX-License-Identifier: Apache-2.0
// Worst-case frame lengths against numbers from the literature and worked out by hand.
#include <gtest/gtest.h>

#include "plumb/drivers/can_form.hpp"

namespace plumb::drivers {
namespace {

using Format = CanFrame::Format;
using Id = CanFrame::Id;

TEST(BusLoad, ClassicFramesAreAsLongAsTheTextbookSays) {
  // [Davis et al. 2007] table: (55 + 10 n) bits with 11-bit, (80 + 10 n) with 29-bit identifiers
  for (int n = 0; n <= 8; ++n) {
    EXPECT_EQ(worst_frame_bits(Format::kClassic, Id::kStandard, static_cast<std::size_t>(n)).slow,
              55.0 + 10.0 * n);
    EXPECT_EQ(worst_frame_bits(Format::kClassic, Id::kExtended, static_cast<std::size_t>(n)).slow,
              80.0 + 10.0 * n);
  }
  EXPECT_EQ(worst_frame_bits(Format::kClassic, Id::kStandard, 8).slow, 135.0);
  EXPECT_EQ(worst_frame_bits(Format::kClassic, Id::kExtended, 8).slow, 160.0);
  EXPECT_EQ(worst_frame_bits(Format::kClassic, Id::kStandard, 8).fast, 0.0);
}

TEST(BusLoad, FdFramesHaveTwoRates) {
  // 17 head + 4 stuff + delimiter 1, acknowledgement 2, end 7, gap 3
  EXPECT_EQ(worst_frame_bits(Format::kFd, Id::kStandard, 8).slow, 34.0);
  EXPECT_EQ(worst_frame_bits(Format::kFd, Id::kExtended, 8).slow, 36.0 + 8.0 + 13.0);
  // n = 8: 5 + 64 data, stuff (17 + 69 - 1) / 4 = 21 less 4, stuff count 4 + CRC 17 + fixed 6
  EXPECT_EQ(worst_frame_bits(Format::kFd, Id::kStandard, 8).fast, 69.0 + 17.0 + 27.0);
  // n = 64: 5 + 512, stuff (17 + 517 - 1) / 4 = 133 less 4, 4 + CRC 21 + fixed 7
  EXPECT_EQ(worst_frame_bits(Format::kFd, Id::kStandard, 64).fast, 517.0 + 129.0 + 32.0);
}

TEST(BusLoad, IsTheSumOverAllFramesOfASecond) {
  BusLayout layout;
  layout.messages = {default_message(MessageKind::kTarget, 6, 0.001)};
  EXPECT_NEAR(worst_bus_load(layout), 3 * 135e-6 / 1e-3, 1e-12);  // 40 % of a 1 kHz cycle
  layout.bit_rate = 500e3;
  EXPECT_NEAR(worst_bus_load(layout), 0.81, 1e-12);
  layout.can_format = Format::kFd;  // 24 + 6 bytes: one frame of 32
  layout.bit_rate = 1e6;
  layout.data_bit_rate = 4e6;
  // 5 + 256 data, stuff (17 + 261 - 1) / 4 = 69 less 4, 32: 358 bits
  EXPECT_NEAR(worst_bus_load(layout), (34.0 + 358.0 / 4.0) * 1e-6 / 1e-3, 1e-12);
}

/// By hand: joints 3, target 3, corrected 3, controller 2 frames every 4 ms; status 4, actual 3
/// every 20 ms; robot 1, context 3, signature 1 every 200 ms.
TEST(BusLoad, TheDefaultLayoutOfASixAxisArmTakesFortyPercentAt250Hz) {
  const double by_hand = 135e-6 * (11 / 4e-3 + 7 / 20e-3 + 5 / 200e-3);
  EXPECT_NEAR(worst_bus_load(default_layout(6, 0.004)), by_hand, 1e-12);
  EXPECT_NEAR(by_hand, 0.42, 0.005);
}

}  // namespace
}  // namespace plumb::drivers
