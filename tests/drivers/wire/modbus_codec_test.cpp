// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/random_numbers.hpp"

namespace plumb::drivers {
namespace {

using Words = std::vector<std::uint16_t>;

BusMessage target() {
  BusMessage out;
  out.kind = MessageKind::kTarget;
  out.size = 6;
  out.counter = 0x1A7;
  out.values = {1.234567, -0.5, 0.75, 0.1, -3.0, NAN};
  return out;
}

Words encoded(const BusLayout& layout, const BusMessage& message) {
  const ModbusCodec codec(layout);
  Words out(codec.block(message.kind).count);
  EXPECT_TRUE(codec.encode(message, out));
  return out;
}

BusLayout low_word_first() {
  BusLayout out = default_layout(6, 0.004);
  out.word_order = ByteOrder::kLittle;
  return out;
}

/// 1234567 = 0x0012D687, -500000 = 0xFFF85EE0, 750000 = 0x000B71B0, 100000 = 0x000186A0,
/// -3000000 = 0xFFD23940, not a number = 0x80000000; the check sums bit by bit elsewhere.
TEST(ModbusCodec, APoseWordForWordInBothOrders) {
  EXPECT_EQ(encoded(default_layout(6, 0.004), target()),
            (Words{0x0012, 0xD687, 0xFFF8, 0x5EE0, 0x000B, 0x71B0, 0x0001, 0x86A0, 0xFFD2, 0x3940,
                   0x8000, 0x0000, 0x01A7, 0x6487, 0x4DB1}));
  EXPECT_EQ(encoded(low_word_first(), target()),
            (Words{0xD687, 0x0012, 0x5EE0, 0xFFF8, 0x71B0, 0x000B, 0x86A0, 0x0001, 0x3940, 0xFFD2,
                   0x0000, 0x8000, 0x01A7, 0xD1C7, 0xCE79}));
}

TEST(ModbusCodec, EveryMessageComesBack) {
  tests::Random random(2);
  for (const auto& layout : {default_layout(9, 0.004, 8), low_word_first()}) {
    ModbusCodec codec(layout);
    for (const MessageLayout& m : layout.messages) {
      BusMessage sent;
      sent.kind = m.kind;
      sent.size = static_cast<std::uint8_t>(m.signals.size());
      sent.counter = static_cast<std::uint16_t>(random.bits());
      for (std::size_t i = 0; i < m.signals.size(); ++i)
        sent.values[i] = m.signals[i].scale * std::round(random.uniform(-2e9, 2e9));
      BusMessage out;
      ASSERT_EQ(codec.decode(m.kind, encoded(layout, sent), out), Heard::kComplete) << m.name;
      EXPECT_EQ(out.kind, m.kind);
      EXPECT_EQ(out.counter, sent.counter);
      EXPECT_EQ(out.size, sent.size);
      for (std::size_t i = 0; i < m.signals.size(); ++i)
        EXPECT_NEAR(out.values[i], sent.values[i], 1e-9 * std::abs(sent.values[i]));
    }
  }
}

TEST(ModbusCodec, TheSameCounterAgainIsRepeated) {
  const BusLayout layout = default_layout(6, 0.004);
  ModbusCodec codec(layout);
  BusMessage out;
  EXPECT_EQ(codec.decode(MessageKind::kTarget, encoded(layout, target()), out), Heard::kComplete);
  EXPECT_TRUE(std::isnan(out.values[5]));
  EXPECT_EQ(codec.decode(MessageKind::kTarget, encoded(layout, target()), out), Heard::kRepeated);
  BusMessage next = target();
  ++next.counter;
  EXPECT_EQ(codec.decode(MessageKind::kTarget, encoded(layout, next), out), Heard::kComplete);
}

TEST(ModbusCodec, FlipsOfUpToTwoBitsAndRandomThreeAreRefused) {
  const BusLayout layout = default_layout(6, 0.004);
  ModbusCodec codec(layout);
  const Words good = encoded(layout, target());
  tests::Random random(4);
  BusMessage out;
  const auto flip = [](Words& words, int bit) {
    words[static_cast<std::size_t>(bit / 16)] ^= static_cast<std::uint16_t>(1U << bit % 16);
  };
  const int bits = static_cast<int>(16 * good.size());
  for (int a = 0; a < bits; ++a)
    for (int b = a; b < bits; ++b) {
      Words wrong = good;
      flip(wrong, a);
      if (b != a) flip(wrong, b);
      ASSERT_EQ(codec.decode(MessageKind::kTarget, wrong, out), Heard::kCorrupt);
      const int c = random.below(bits);
      if (c == a || c == b) continue;
      flip(wrong, c);
      ASSERT_EQ(codec.decode(MessageKind::kTarget, wrong, out), Heard::kCorrupt);
    }
}

TEST(ModbusCodec, ABlockOfZerosHoldsNothingUntilTheFirstMessageAndOneOfOnesIsCorrupt) {
  for (int joints = 1; joints <= 9; ++joints) {
    const BusLayout layout = default_layout(joints, 0.004, 8);
    ModbusCodec codec(layout);
    BusMessage out;
    for (const MessageLayout& m : layout.messages)
      for (const int word : {0x0000, 0xFFFF}) {
        const Words words(codec.block(m.kind).count, static_cast<std::uint16_t>(word));
        EXPECT_EQ(codec.decode(m.kind, words, out), word == 0 ? Heard::kNothing : Heard::kCorrupt)
            << m.name;
      }
    EXPECT_EQ(codec.decode(MessageKind::kTarget, encoded(layout, target()), out), Heard::kComplete);
    const Words zeros(codec.block(MessageKind::kTarget).count);
    EXPECT_EQ(codec.decode(MessageKind::kTarget, zeros, out), Heard::kCorrupt);
  }
}

TEST(ModbusCodec, AWithdrawnMessageIsNoneWithoutBeingCorruptAndBendsLikeAnyOther) {
  const BusLayout layout = default_layout(6, 0.004);
  ModbusCodec codec(layout);
  Words words = encoded(layout, target());
  ModbusCodec::withdraw(words);
  BusMessage out;
  EXPECT_EQ(codec.decode(MessageKind::kTarget, words, out), Heard::kNothing);
  for (std::size_t bit = 0; bit < 16 * words.size(); ++bit) {
    Words wrong = words;
    wrong[bit / 16] = static_cast<std::uint16_t>(wrong[bit / 16] ^ (1U << bit % 16));
    EXPECT_EQ(codec.decode(MessageKind::kTarget, wrong, out), Heard::kCorrupt) << bit;
  }
  EXPECT_EQ(codec.decode(MessageKind::kTarget, encoded(layout, target()), out), Heard::kComplete);
}

TEST(ModbusCodec, ABlockReadFromAnotherAddressIsCorrupt) {
  const BusLayout layout = default_layout(6, 0.004);
  ModbusCodec codec(layout);
  BusMessage out;
  const Words target_words = encoded(layout, target());
  EXPECT_EQ(codec.decode(MessageKind::kActual, target_words, out), Heard::kCorrupt);
  EXPECT_EQ(codec.decode(MessageKind::kJoints, target_words, out), Heard::kCorrupt);
}

TEST(ModbusCodec, OtherLengthsAndOtherMessagesAreRefused) {
  const BusLayout layout = default_layout(6, 0.004);
  ModbusCodec codec(layout);
  BusMessage out;
  Words words = encoded(layout, target());
  words.push_back(0);
  EXPECT_EQ(codec.decode(MessageKind::kTarget, words, out), Heard::kCorrupt);
  EXPECT_EQ(codec.decode(MessageKind::kTarget, {}, out), Heard::kCorrupt);
  EXPECT_EQ(codec.decode(MessageKind::kOffset, words, out), Heard::kNotOurs);
  EXPECT_EQ(codec.block(MessageKind::kOffset).count, 0);
  EXPECT_FALSE(codec.encode(target(), words));
}

TEST(ModbusCodec, WhatIsNeededEveryCycleLiesWithinOneRequestOf125Registers) {
  for (int joints = 1; joints <= 9; ++joints) {
    const ModbusCodec codec(default_layout(joints, 0.004));
    for (const auto kind : {MessageKind::kJoints, MessageKind::kCommanded, MessageKind::kTarget,
                            MessageKind::kActual, MessageKind::kController, MessageKind::kRobot}) {
      const auto block = codec.block(kind);
      if (block.count == 0) continue;
      EXPECT_GE(block.first, 1000);
      EXPECT_LE(block.first + block.count, 1125);
    }
  }
}

}  // namespace
}  // namespace plumb::drivers
