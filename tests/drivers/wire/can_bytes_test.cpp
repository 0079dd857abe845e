// SPDX-License-Identifier: Apache-2.0
// Frames byte for byte. The numbers were worked out by hand, their check sums bit by bit elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plumb/drivers/can_codec.hpp"

namespace plumb::drivers {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes data_of(const CanFrame& frame) {
  return {frame.data.begin(), frame.data.begin() + frame.length};
}

BusMessage target() {
  BusMessage out;
  out.kind = MessageKind::kTarget;
  out.size = 6;
  out.counter = 0x1A7;
  out.values = {1.234567, -0.5, 0.75, 0.1, -3.0, NAN};
  return out;
}

TEST(CanBytes, ThreeClassicFramesHoldAPoseInMicrometresAndMicroradians) {
  CanCodec codec(default_layout(6, 0.004));
  const auto frames = codec.encode(target());
  ASSERT_EQ(frames.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frames[i].id, 0x118 + i);
    EXPECT_EQ(frames[i].format, CanFrame::Format::kClassic);
    EXPECT_EQ(frames[i].id_kind, CanFrame::Id::kStandard);
  }
  // 1234567 = 0x12D687, -500000 = 0xF85EE0, 750000 = 0x0B71B0, 100000 = 0x0186A0,
  // -3000000 = 0xD23940, not a number = 0x800000; counter 0xA7
  EXPECT_EQ(data_of(frames[0]), (Bytes{0x87, 0xD6, 0x12, 0xE0, 0x5E, 0xF8, 0xA7, 0xA9}));
  EXPECT_EQ(data_of(frames[1]), (Bytes{0xB0, 0x71, 0x0B, 0xA0, 0x86, 0x01, 0xA7, 0x68}));
  EXPECT_EQ(data_of(frames[2]), (Bytes{0x40, 0x39, 0xD2, 0x00, 0x00, 0x80, 0xA7, 0x31}));
}

TEST(CanBytes, BigEndianTurnsEachValueRound) {
  BusLayout layout = default_layout(6, 0.004);
  layout.byte_order = ByteOrder::kBig;
  CanCodec codec(layout);
  EXPECT_EQ(data_of(codec.encode(target())[0]),
            (Bytes{0x12, 0xD6, 0x87, 0xF8, 0x5E, 0xE0, 0xA7, 0x4D}));
}

TEST(CanBytes, AnOffsetIsTwoFramesOfThreeInt16) {
  CanCodec codec(default_layout(6, 0.002, 0, CorrectionForm::kOffset));
  BusMessage offset;
  offset.kind = MessageKind::kOffset;
  offset.size = 6;
  offset.counter = 7;
  offset.values = {0.0001234, -0.0005, -1.0, 1e-6, -2e-6, NAN};
  const auto frames = codec.encode(offset);
  ASSERT_EQ(frames.size(), 2U);
  // 123.4 um = 1234 = 0x04D2, -500 um = -5000 = 0xEC78, -1 m saturates at -32767 = 0x8001
  EXPECT_EQ(data_of(frames[0]), (Bytes{0xD2, 0x04, 0x78, 0xEC, 0x01, 0x80, 0x07, 0x6D}));
  EXPECT_EQ(data_of(frames[1]), (Bytes{0x01, 0x00, 0xFE, 0xFF, 0x00, 0x80, 0x07, 0xCB}));
}

TEST(CanBytes, APlaceWithoutAValueIsZero) {
  CanCodec codec(default_layout(6, 0.004));
  BusMessage robot;
  robot.kind = MessageKind::kRobot;
  robot.size = 1;
  robot.counter = 1;
  robot.values[0] = 0x123456;
  EXPECT_EQ(data_of(codec.encode(robot)[0]),
            (Bytes{0x56, 0x34, 0x12, 0x00, 0x00, 0x00, 0x01, 0xB9}));
}

TEST(CanBytes, OneFdFrameHoldsInt32CounterCheckSumAndPadding) {
  BusLayout layout = default_layout(6, 0.001);
  layout.can_format = CanFrame::Format::kFd;
  CanCodec codec(layout);
  const auto frames = codec.encode(target());
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(data_of(frames[0]),
            (Bytes{0x87, 0xD6, 0x12, 0x00, 0xE0, 0x5E, 0xF8, 0xFF, 0xB0, 0x71, 0x0B,
                   0x00, 0xA0, 0x86, 0x01, 0x00, 0x40, 0x39, 0xD2, 0xFF, 0x00, 0x00,
                   0x00, 0x80, 0xA7, 0x01, 0xA9, 0x58, 0xBD, 0xF6, 0x00, 0x00}));
}

}  // namespace
}  // namespace plumb::drivers
