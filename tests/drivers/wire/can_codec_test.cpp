// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_codec.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/random_numbers.hpp"

namespace plumb::drivers {
namespace {

constexpr std::int64_t kCycle = 4'000'000;

/// A sender and a receiver of one layout.
class Wire : public testing::Test {
 protected:
  Wire() : Wire(default_layout(6, 0.004)) {}
  explicit Wire(BusLayout l) : layout(std::move(l)), sender(layout), receiver(layout) {}

  BusMessage message(MessageKind kind, int counter, double value = 0.1) {
    BusMessage sent;
    sent.kind = kind;
    sent.size = static_cast<std::uint8_t>(layout.find(kind)->signals.size());
    sent.counter = static_cast<std::uint16_t>(counter);
    for (int i = 0; i < sent.size; ++i) sent.values[static_cast<std::size_t>(i)] = value + 0.01 * i;
    return sent;
  }
  std::vector<CanFrame> frames(int counter, double value = 0.1) {
    const auto encoded = sender.encode(message(MessageKind::kTarget, counter, value));
    std::vector<CanFrame> sent(encoded.begin(), encoded.end());
    for (CanFrame& frame : sent) frame.time_ns = now;
    return sent;
  }
  /// All frames of a target; what the last was worth.
  Heard hear_all(int counter, double value = 0.1) {
    Heard last = Heard::kNotOurs;
    for (const CanFrame& frame : frames(counter, value)) last = receiver.hear(frame, out);
    return last;
  }

  BusLayout layout;
  CanCodec sender, receiver;
  BusMessage out;
  std::int64_t now = 1'000'000'000;
};

TEST_F(Wire, EveryMessageComesBackWithinHalfACount) {
  tests::Random random(1);
  for (const auto format : {CanFrame::Format::kClassic, CanFrame::Format::kFd})
    for (const auto order : {ByteOrder::kLittle, ByteOrder::kBig})
      for (const auto form : {CorrectionForm::kPose, CorrectionForm::kOffset})
        for (int joints = 1; joints <= 9; ++joints) {
          BusLayout l = default_layout(joints, 0.004, joints - 1, form);
          l.can_format = format;
          l.byte_order = order;
          CanCodec codec(l);
          for (const MessageLayout& m : l.messages) {
            BusMessage sent;
            sent.kind = m.kind;
            sent.size = static_cast<std::uint8_t>(m.signals.size());
            sent.counter = static_cast<std::uint16_t>(random.bits());
            for (std::size_t i = 0; i < m.signals.size(); ++i)
              sent.values[i] = m.signals[i].scale * random.uniform(-32767.0, 32767.0);
            Heard last = Heard::kNotOurs;
            const auto encoded = codec.encode(sent);
            ASSERT_EQ(encoded.size(), can_frames(l, m));
            for (const CanFrame& frame : encoded) last = codec.hear(frame, out);
            ASSERT_EQ(last, Heard::kComplete) << m.name;
            EXPECT_EQ(out.kind, m.kind);
            EXPECT_EQ(out.size, sent.size);
            EXPECT_EQ(out.counter,
                      format == CanFrame::Format::kFd ? sent.counter : sent.counter & 0xFF);
            for (std::size_t i = 0; i < m.signals.size(); ++i)
              EXPECT_NEAR(out.values[i], sent.values[i], 0.5001 * m.signals[i].scale);
            for (std::size_t i = m.signals.size(); i < kMaxMessageValues; ++i)
              EXPECT_TRUE(std::isnan(out.values[i]));
          }
        }
}

TEST_F(Wire, WholeNumbersUpToTwentyThreeBitsAreExact) {
  for (const double number : {0.0, 1.0, -1.0, 8388606.0, 8388607.0, -8388607.0}) {
    BusMessage robot = message(MessageKind::kRobot, 1);
    robot.values[0] = number;
    CanCodec fresh(layout);
    ASSERT_EQ(fresh.hear(sender.encode(robot)[0], out), Heard::kComplete);
    EXPECT_EQ(out.values[0], number);
  }
}

TEST_F(Wire, SaturatesAlikeOnBothSidesAndNeverWrapsRound) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double beyond : {8.388608, 9.0, 1e6, 1e308, kInf}) {
    BusMessage sent = message(MessageKind::kTarget, 1);
    sent.values[0] = beyond;
    sent.values[1] = -beyond;
    CanCodec fresh(layout);
    for (const CanFrame& frame : sender.encode(sent)) (void)fresh.hear(frame, out);
    EXPECT_EQ(out.values[0], 8388607 * 1e-6);
    EXPECT_EQ(out.values[1], -8388607 * 1e-6);
  }
}

TEST_F(Wire, NotANumberHasACodeOfItsOwn) {
  BusMessage sent = message(MessageKind::kTarget, 1);
  sent.values[3] = NAN;
  for (const CanFrame& frame : sender.encode(sent)) (void)receiver.hear(frame, out);
  EXPECT_TRUE(std::isnan(out.values[3]));
  EXPECT_NEAR(out.values[2], sent.values[2], 1e-6);
}

TEST_F(Wire, AMessageCountsOnceAllFramesAreThereInAnyOrder) {
  std::vector<int> order{0, 1, 2};
  int counter = 0;
  do {
    const auto sent = frames(++counter);
    EXPECT_EQ(receiver.hear(sent[order[0]], out), Heard::kPart);
    EXPECT_EQ(receiver.hear(sent[order[1]], out), Heard::kPart);
    EXPECT_EQ(receiver.hear(sent[order[2]], out), Heard::kComplete);
    now += kCycle;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(receiver.skipped(), 0U);
  EXPECT_EQ(receiver.incomplete(), 0U);
}

TEST_F(Wire, FramesOfTwoCyclesNeverMix) {
  const auto before = frames(1, 0.1);
  now += kCycle;
  const auto after = frames(2, 0.2);
  EXPECT_EQ(receiver.hear(before[0], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(before[1], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(after[2], out), Heard::kPart);  // of 2: 1 is given up
  EXPECT_EQ(receiver.hear(after[0], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(before[2], out), Heard::kRepeated);  // overtaken
  EXPECT_EQ(receiver.hear(after[1], out), Heard::kComplete);
  EXPECT_NEAR(out.values[0], 0.2, 1e-6);
  EXPECT_NEAR(out.values[2], 0.22, 1e-6);
  EXPECT_EQ(receiver.incomplete(), 1U);
}

TEST_F(Wire, TheSameCounterARoundLaterIsAnotherCycle) {
  EXPECT_EQ(receiver.hear(frames(5, 0.1)[0], out), Heard::kPart);
  now += 256 * kCycle;
  const auto later = frames(5 + 256, 0.3);
  EXPECT_EQ(receiver.hear(later[1], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(later[2], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(later[0], out), Heard::kComplete);
  EXPECT_NEAR(out.values[0], 0.3, 1e-6);
  now += 256 * kCycle;
  EXPECT_EQ(hear_all(5), Heard::kComplete);  // and so is one that was complete a round ago
}

TEST_F(Wire, ADuplicatedFrameChangesNothing) {
  const auto sent = frames(1);
  EXPECT_EQ(receiver.hear(sent[0], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(sent[0], out), Heard::kRepeated);
  EXPECT_EQ(receiver.hear(sent[1], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(sent[2], out), Heard::kComplete);
  EXPECT_EQ(receiver.hear(sent[2], out), Heard::kRepeated);
  EXPECT_EQ(hear_all(1), Heard::kRepeated);
  EXPECT_EQ(hear_all(2), Heard::kComplete);
}

TEST_F(Wire, AnotherContentUnderTheSameCounterBeginsAnew) {
  const auto one = frames(1, 0.1), other = frames(1, 0.2);
  EXPECT_EQ(receiver.hear(one[0], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(one[1], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(other[0], out), Heard::kPart);
  EXPECT_EQ(receiver.hear(other[2], out), Heard::kPart);  // one[1] does not count for it
  EXPECT_EQ(receiver.incomplete(), 1U);
}

TEST_F(Wire, ALateMessageDoesNotReplaceANewerOne) {
  const auto late = frames(1, 0.1);
  now += kCycle;
  EXPECT_EQ(hear_all(2, 0.2), Heard::kComplete);
  for (const CanFrame& frame : late) EXPECT_EQ(receiver.hear(frame, out), Heard::kRepeated);
}

TEST_F(Wire, ASenderThatBeginsAnewIsHeard) {
  EXPECT_EQ(hear_all(200), Heard::kComplete);
  now += kCycle;
  EXPECT_EQ(hear_all(0), Heard::kComplete);  // far behind
  EXPECT_EQ(receiver.skipped(), 55U);        // or 55 lost: no one can tell
  EXPECT_EQ(hear_all(10), Heard::kComplete);
  now += CanCodec::kOvertaken * kCycle;
  EXPECT_EQ(hear_all(0), Heard::kComplete);  // close behind, but long after
}

TEST_F(Wire, CountersThatNeverCameAreCounted) {
  EXPECT_EQ(hear_all(250), Heard::kComplete);
  now += kCycle;
  EXPECT_EQ(hear_all(251), Heard::kComplete);
  EXPECT_EQ(receiver.skipped(), 0U);
  now += 7 * kCycle;
  EXPECT_EQ(hear_all(258), Heard::kComplete);  // 252 to 257 are missing, across the wrap
  EXPECT_EQ(receiver.skipped(), 6U);
}

TEST_F(Wire, AMessageThatComesEveryFifthCycleSkipsNothing) {
  for (int counter = 0; counter < 1000; counter += 5) {
    for (CanFrame frame : sender.encode(message(MessageKind::kStatus, counter))) {
      frame.time_ns = now + counter * kCycle;
      (void)receiver.hear(frame, out);
    }
    ASSERT_EQ(out.counter, counter & 0xFF);
  }
  EXPECT_EQ(receiver.skipped(), 0U);
}

TEST_F(Wire, AMessageIsAsOldAsItsEarliestFrame) {
  auto sent = frames(1);
  sent[1].time_ns += 1000;
  sent[2].time_ns += 2000;
  for (const CanFrame& frame : sent) (void)receiver.hear(frame, out);
  EXPECT_EQ(out.time_ns, now);
}

TEST_F(Wire, FramesOfAnotherShapeAreCorruptAndOtherIdentifiersNotOurs) {
  const CanFrame good = frames(1)[0];
  CanFrame frame = good;
  frame.length = 7;
  EXPECT_EQ(receiver.hear(frame, out), Heard::kCorrupt);
  frame = good;
  frame.format = CanFrame::Format::kFd;
  EXPECT_EQ(receiver.hear(frame, out), Heard::kCorrupt);
  frame = good;
  frame.id_kind = CanFrame::Id::kExtended;
  EXPECT_EQ(receiver.hear(frame, out), Heard::kNotOurs);
  frame = good;
  frame.id = 0x7FF;
  EXPECT_EQ(receiver.hear(frame, out), Heard::kNotOurs);
  frame.id = 0xFFFFFFFF;
  EXPECT_EQ(receiver.hear(frame, out), Heard::kNotOurs);
}

TEST_F(Wire, AMessageThatTheLayoutLacksHasNoFrames) {
  BusMessage offset;
  offset.kind = MessageKind::kOffset;
  EXPECT_TRUE(sender.encode(offset).empty());
}

TEST_F(Wire, OfLostDuplicatedAndReorderedFramesOnlyWholeNewerMessagesCome) {
  tests::Random random(9);
  const long cases = tests::scaled(20000);
  std::printf("%ld cycles, seed 9\n", cases);
  std::vector<CanFrame> air;
  double newest = 0.0;
  long complete = 0;
  for (long i = 1; i <= cases; ++i, now += kCycle) {
    for (const CanFrame& frame :
         frames(static_cast<int>(i & 0xFFFF), 1e-6 * static_cast<double>(i % 1000000)))
      for (int copies = random.below(10) < 3 ? 0 : 1 + random.below(2); copies > 0; --copies)
        air.push_back(frame);
    while (air.size() > 6) {
      const auto pick = air.begin() + random.below(static_cast<int>(air.size()));
      CanFrame frame = *pick;
      frame.time_ns = now;
      air.erase(pick);
      if (receiver.hear(frame, out) != Heard::kComplete) continue;
      ++complete;
      for (int k = 0; k < 6; ++k)
        ASSERT_NEAR(out.values[static_cast<std::size_t>(k)] - out.values[0], 0.01 * k, 2e-6)
            << "torn";
      ASSERT_GT(out.values[0], newest);
      newest = out.values[0];
    }
  }
  EXPECT_GT(complete, cases / 10);
}

}  // namespace
}  // namespace plumb::drivers
