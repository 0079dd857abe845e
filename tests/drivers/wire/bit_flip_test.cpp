// SPDX-License-Identifier: Apache-2.0
// No flip of up to three bits of a frame passes for a sound one.
#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <vector>

#include "plumb/drivers/can_codec.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::drivers {
namespace {

void flip(CanFrame& frame, int bit) {
  frame.data[static_cast<std::size_t>(bit / 8)] ^= static_cast<std::uint8_t>(1U << bit % 8);
}

BusMessage random_message(MessageKind kind, const BusLayout& layout, tests::Random& random) {
  BusMessage out;
  out.kind = kind;
  out.size = static_cast<std::uint8_t>(layout.find(kind)->signals.size());
  out.counter = static_cast<std::uint16_t>(random.bits());
  for (std::size_t i = 0; i < out.size; ++i) out.values[i] = random.uniform(-3.0, 3.0);
  return out;
}

/// Calls `check` with every frame that differs from `frame` in one to three bits of its data.
long each_flip(const CanFrame& frame, const std::function<void(const CanFrame&)>& check) {
  long count = 0;
  const int bits = 8 * frame.length;
  for (int a = 0; a < bits; ++a)
    for (int b = a; b < bits; ++b)
      for (int c = b; c < bits; ++c) {
        if (a == b && b != c) continue;  // that is a and c, met as (a, c, c)
        CanFrame wrong = frame;
        flip(wrong, a);
        if (b != a) flip(wrong, b);
        if (c != b) flip(wrong, c);
        check(wrong);
        ++count;
      }
  return count;
}

constexpr long kUpToThreeOf64 = 64 + 2016 + 41664;

class BitFlips : public testing::TestWithParam<MessageKind> {};

TEST_P(BitFlips, OneTwoAndThreeOfAClassicFrameAreAllRefused) {
  const BusLayout layout = default_layout(6, 0.004, 2);
  CanCodec codec(layout);
  tests::Random random(5);
  const auto encoded = codec.encode(random_message(GetParam(), layout, random));
  for (const CanFrame& frame : std::vector<CanFrame>(encoded.begin(), encoded.end())) {
    long accepted = 0;
    const long count = each_flip(frame, [&](const CanFrame& wrong) {
      BusMessage out;
      accepted += codec.hear(wrong, out) == Heard::kCorrupt ? 0 : 1;
    });
    EXPECT_EQ(count, kUpToThreeOf64);
    EXPECT_EQ(accepted, 0);
    BusMessage out;
    EXPECT_NE(codec.hear(frame, out), Heard::kCorrupt);
  }
}

INSTANTIATE_TEST_SUITE_P(Messages, BitFlips,
                         testing::Values(MessageKind::kTarget, MessageKind::kController,
                                         MessageKind::kRobot, MessageKind::kCorrected));

TEST(BitFlips, OfTheIdentifierAndUpToTwoOfTheDataAreNeverAccepted) {
  for (const auto id_kind : {CanFrame::Id::kStandard, CanFrame::Id::kExtended}) {
    BusLayout layout = default_layout(6, 0.008);
    layout.id_kind = id_kind;
    CanCodec codec(layout);
    tests::Random random(6);
    const CanFrame frame = codec.encode(random_message(MessageKind::kTarget, layout, random))[1];
    const int bits = id_kind == CanFrame::Id::kStandard ? 11 : 29;
    long ours = 0;
    for (int i = 0; i < bits; ++i)
      for (int a = 0; a < 64; ++a)
        for (int b = a; b < 64; ++b) {
          CanFrame wrong = frame;
          wrong.id ^= 1U << i;
          flip(wrong, a);
          if (b != a) flip(wrong, b);
          BusMessage out;
          const Heard heard = codec.hear(wrong, out);
          ours += heard == Heard::kCorrupt ? 1 : 0;
          ASSERT_TRUE(heard == Heard::kCorrupt || heard == Heard::kNotOurs);
        }
    EXPECT_GT(ours, 0);  // some flips do lead to another message of ours
  }
}

/// Every identifier of the layout with the data of every other frame: a gateway that mixes them up.
TEST(BitFlips, NoFramePassesUnderAnotherIdentifierOfTheLayout) {
  const BusLayout layout = default_layout(9, 0.008, 8);
  CanCodec codec(layout);
  tests::Random random(7);
  std::vector<CanFrame> frames;
  for (const MessageLayout& message : layout.messages)
    for (const CanFrame& frame : codec.encode(random_message(message.kind, layout, random)))
      frames.push_back(frame);
  for (const CanFrame& data : frames)
    for (const CanFrame& other : frames) {
      if (data.id == other.id) continue;
      CanFrame wrong = data;
      wrong.id = other.id;
      const int far = std::popcount(data.id ^ other.id);
      BusMessage out;
      const Heard heard = codec.hear(wrong, out);
      EXPECT_TRUE(far > 3 || heard == Heard::kCorrupt) << data.id << " as " << other.id;
    }
}

TEST(BitFlips, OneAndTwoOfAnFdFrameAreAllRefusedAndRandomThree) {
  BusLayout layout = default_layout(9, 0.001);
  layout.can_format = CanFrame::Format::kFd;
  CanCodec codec(layout);
  tests::Random random(8);
  const CanFrame frame = codec.encode(random_message(MessageKind::kJoints, layout, random))[0];
  ASSERT_EQ(frame.length, 48);  // 36 of values, 2 counter, 4 check sum, 6 padding
  BusMessage out;
  for (int a = 0; a < 8 * 48; ++a)
    for (int b = a; b < 8 * 48; ++b) {
      CanFrame wrong = frame;
      flip(wrong, a);
      if (b != a) flip(wrong, b);
      ASSERT_EQ(codec.hear(wrong, out), Heard::kCorrupt);
      const int c = random.below(8 * 48);
      if (c == a || c == b) continue;
      flip(wrong, c);
      ASSERT_EQ(codec.hear(wrong, out), Heard::kCorrupt);
    }
  EXPECT_EQ(codec.hear(frame, out), Heard::kComplete);
}

}  // namespace
}  // namespace plumb::drivers
