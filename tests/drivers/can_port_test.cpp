// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_port.hpp"

#include <gtest/gtest.h>
#include <linux/can/error.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/drivers/socket_pair.hpp"

namespace plumb::drivers {
namespace {

constexpr std::int64_t kMs = 1'000'000;

BusLayout layout_of(CanFrame::Format format) {
  BusLayout out = default_layout(6, 0.004);
  out.can_format = format;
  return out;
}

/// plumb-rt on one end, the controller on the other.
struct TwoEnds {
  explicit TwoEnds(const BusLayout& layout, int type = SOCK_SEQPACKET)
      : sockets(type),
        plumb(CanLink(sockets.link_end(), can_link_options(layout)), layout, Sender::kPlumb),
        controller(CanLink(sockets.release(), can_link_options(layout)), layout,
                   Sender::kController) {}

  tests::SocketPair sockets;
  CanPort plumb;
  CanPort controller;
};

/// plumb-rt on one end, bytes on the other.
struct BareEnd {
  explicit BareEnd(const BusLayout& layout)
      : plumb(CanLink(sockets.link_end(), can_link_options(layout)), layout, Sender::kPlumb) {}

  tests::SocketPair sockets;
  CanPort plumb;
  BusMessage message;
};

BusMessage joints(std::uint16_t counter, double q1 = 0.1) {
  BusMessage out{.kind = MessageKind::kJoints, .size = 6, .counter = counter};
  for (std::size_t i = 0; i < 6; ++i) out.values[i] = q1 * static_cast<double>(i + 1);
  return out;
}

std::vector<can_frame> classic_frames(const BusLayout& layout, const BusMessage& message) {
  CanCodec codec(layout);
  std::vector<can_frame> out;
  for (const CanFrame& frame : codec.encode(message))
    out.push_back(tests::classic(frame.id, {frame.data.begin(), frame.data.begin() + 8}));
  return out;
}

class EveryFormat : public testing::TestWithParam<CanFrame::Format> {};
INSTANTIATE_TEST_SUITE_P(CanPort, EveryFormat,
                         testing::Values(CanFrame::Format::kClassic, CanFrame::Format::kFd),
                         [](const auto& one) {
                           return one.param == CanFrame::Format::kFd ? "Fd" : "Classic";
                         });

TEST_P(EveryFormat, CarriesEveryMessageOfTheLayoutToTheOtherEndOnly) {
  const BusLayout layout = layout_of(GetParam());
  TwoEnds ends(layout);
  BusMessage heard;
  for (const auto& entry : layout.messages) {
    BusMessage message{.kind = entry.kind, .size = static_cast<std::uint8_t>(entry.signals.size())};
    message.counter = 77;
    for (std::size_t i = 0; i < message.size; ++i)
      message.values[i] = entry.signals[i].scale * static_cast<double>(i + 1);
    const bool ours = entry.sender == Sender::kPlumb;
    EXPECT_EQ(ends.plumb.send(message), ours) << entry.name;
    EXPECT_EQ(ends.controller.send(message), !ours) << entry.name;
    CanPort& other = ours ? ends.controller : ends.plumb;
    ASSERT_TRUE(other.receive(heard)) << entry.name;
    EXPECT_EQ(heard.kind, entry.kind);
    EXPECT_EQ(heard.counter & 0xFF, 77);
    for (std::size_t i = 0; i < message.size; ++i)
      EXPECT_NEAR(heard.values[i], message.values[i], 0.5 * entry.signals[i].scale);
    EXPECT_FALSE(other.receive(heard));
  }
  EXPECT_EQ(ends.plumb.counters().received + ends.controller.counters().received,
            layout.messages.size());
  EXPECT_EQ(ends.plumb.counters().foreign_senders, 0U);
}

TEST_P(EveryFormat, HearsNothingOfAMessageWhoseFrameWasBent) {
  const BusLayout layout = layout_of(GetParam());
  CanCodec codec(layout);
  BareEnd end(layout);
  std::uint64_t bent = 0;
  for (const CanFrame& frame : codec.encode(joints(9))) {
    for (std::size_t bit = 0; bit < 8U * frame.length; ++bit) {
      canfd_frame wire = tests::fd(frame.id, frame.length, 0);
      std::copy_n(frame.data.begin(), frame.length, wire.data);
      wire.data[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      const bool fd = frame.format == CanFrame::Format::kFd;
      ASSERT_TRUE(end.sockets.put_bytes(&wire, fd ? CANFD_MTU : CAN_MTU));
      ++bent;
      EXPECT_FALSE(end.plumb.receive(end.message));
    }
  }
  EXPECT_EQ(end.plumb.counters().corrupt, bent);
  EXPECT_EQ(end.plumb.counters().received, 0U);
}

TEST(CanPort, CountsAFrameOfItsOwnIdentifierAsAForeignSender) {
  const BusLayout layout = layout_of(CanFrame::Format::kClassic);
  const MessageLayout& ours = *layout.find(MessageKind::kCorrected);
  BareEnd end(layout);
  for (std::uint32_t i = 0; i < 3; ++i)
    ASSERT_TRUE(end.sockets.put(tests::classic(ours.can_id + i, {0, 0, 0, 0, 0, 0, 0, 0})));
  EXPECT_FALSE(end.plumb.receive(end.message));
  EXPECT_EQ(end.plumb.counters().foreign_senders, 3U);
  EXPECT_EQ(end.plumb.counters().corrupt, 0U);
  // the same number with 29 bits is another identifier
  ASSERT_TRUE(end.sockets.put(tests::classic(ours.can_id | CAN_EFF_FLAG, {0})));
  EXPECT_FALSE(end.plumb.receive(end.message));
  EXPECT_EQ(end.plumb.counters().foreign_senders, 3U);
}

TEST(CanPort, CountsRepeatedSkippedAndForgetsWhatIsNotComplete) {
  const BusLayout layout = layout_of(CanFrame::Format::kClassic);
  BareEnd end(layout);
  const auto put = [&](const std::vector<can_frame>& frames) {
    for (const auto& frame : frames) ASSERT_TRUE(end.sockets.put(frame));
  };
  put(classic_frames(layout, joints(1)));
  put(classic_frames(layout, joints(1)));
  EXPECT_TRUE(end.plumb.receive(end.message));
  EXPECT_FALSE(end.plumb.receive(end.message));
  EXPECT_EQ(end.plumb.counters().repeated, 3U);
  auto partial = classic_frames(layout, joints(2));
  partial.pop_back();
  put(partial);
  put(classic_frames(layout, joints(4)));
  EXPECT_TRUE(end.plumb.receive(end.message));
  EXPECT_EQ(end.message.counter, 4);
  EXPECT_FALSE(end.plumb.receive(end.message));
  EXPECT_EQ(end.plumb.counters().skipped, 2U);
}

TEST(CanPort, HearsPartsInAnyOrderButNeverOfTwoCycles) {
  const BusLayout layout = layout_of(CanFrame::Format::kClassic);
  BareEnd end(layout);
  const auto one = classic_frames(layout, joints(1, 0.1));
  const auto two = classic_frames(layout, joints(2, 0.2));
  for (const auto& frame : {one[2], one[0], two[1], two[0], two[2]})
    ASSERT_TRUE(end.sockets.put(frame));
  ASSERT_TRUE(end.plumb.receive(end.message));
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(end.message.values[i], 0.2 * static_cast<double>(i + 1), 1e-6);
  EXPECT_FALSE(end.plumb.receive(end.message));
}

TEST(CanPort, IsNotHeldUpByAFloodOfFramesWithoutAMessage) {
  const BusLayout layout = layout_of(CanFrame::Format::kClassic);
  BareEnd end(layout);
  int put = 0;
  while (put < 4 * CanPort::kMostFramesACall &&
         end.sockets.put(tests::classic(layout.find(MessageKind::kStatus)->can_id, {})))
    ++put;
  ASSERT_GT(put, CanPort::kMostFramesACall);
  EXPECT_FALSE(end.plumb.receive(end.message));
  EXPECT_EQ(end.plumb.counters().foreign_senders,
            static_cast<std::uint64_t>(CanPort::kMostFramesACall));
}

TEST(CanPort, CountsAMessageThatFoundNoRoomOnce) {
  const BusLayout layout = layout_of(CanFrame::Format::kClassic);
  BareEnd end(layout);
  BusMessage status{.kind = MessageKind::kStatus, .size = 7};
  std::uint64_t sent = 0;
  while (sent < 100'000 && end.plumb.send(status)) ++sent;
  EXPECT_LT(sent, 100'000U);
  EXPECT_EQ(end.plumb.counters().sent, sent);
  EXPECT_EQ(end.plumb.counters().not_sent, 1U);
}

TEST(CanPort, SendsNothingThatIsNotInTheLayout) {
  const BusLayout layout = layout_of(CanFrame::Format::kClassic);
  BareEnd end(layout);
  EXPECT_FALSE(end.plumb.send({.kind = MessageKind::kOffset, .size = 6}));
  EXPECT_TRUE(end.sockets.take().empty());
  EXPECT_EQ(end.plumb.counters().not_sent, 1U);
}

TEST(CanPort, ListensToExactlyTheIdentifiersOfTheLayout) {
  const BusLayout layout = layout_of(CanFrame::Format::kClassic);
  const auto filters = can_filters(layout);
  std::size_t frames = 0;
  for (const auto& message : layout.messages) frames += can_frames(layout, message);
  EXPECT_EQ(filters.size(), frames);
  for (const auto& message : layout.messages)
    EXPECT_TRUE(std::any_of(filters.begin(), filters.end(), [&](const CanFilter& filter) {
      return filter.id == message.can_id && filter.id_kind == layout.id_kind;
    })) << message.name;
}

TEST(CanPort, SwitchesTheBitRateOnlyIfTheLayoutHasTwo) {
  BusLayout layout = layout_of(CanFrame::Format::kFd);
  EXPECT_EQ(can_link_options(layout).data_phase, CanLinkOptions::DataPhase::kSwitched);
  layout.data_bit_rate = layout.bit_rate;
  EXPECT_EQ(can_link_options(layout).data_phase, CanLinkOptions::DataPhase::kOneRate);
  EXPECT_EQ(can_link_options(layout).format, CanFrame::Format::kFd);
}

TEST(CanPort, SaysOfAMessageThatItIsNoNewerThanItsFirstFrame) {
  const BusLayout layout = layout_of(CanFrame::Format::kClassic);
  BareEnd end(layout);
  const auto frames = classic_frames(layout, joints(1));
  const std::int64_t begin_ns = ClockReading::now().monotonic_ns;
  ASSERT_TRUE(end.sockets.put(frames[0]));
  EXPECT_FALSE(end.plumb.receive(end.message));
  ::usleep(20'000);
  ASSERT_TRUE(end.sockets.put(frames[1]));
  ASSERT_TRUE(end.sockets.put(frames[2]));
  ASSERT_TRUE(end.plumb.receive(end.message));
  EXPECT_LT(end.message.time_ns, begin_ns + 10 * kMs);
}

TEST(CanPort, ShowsTheStateOfItsLink) {
  const BusLayout layout = layout_of(CanFrame::Format::kClassic);
  BareEnd end(layout);
  EXPECT_EQ(end.plumb.state(), LinkState::kUp);
  ASSERT_TRUE(
      end.sockets.put(tests::classic(CAN_ERR_FLAG | CAN_ERR_BUSOFF, {0, 0, 0, 0, 0, 0, 0, 0})));
  EXPECT_FALSE(end.plumb.receive(end.message));
  EXPECT_EQ(end.plumb.state(), LinkState::kDown);
  ASSERT_TRUE(
      end.sockets.put(tests::classic(CAN_ERR_FLAG | CAN_ERR_RESTARTED, {0, 0, 0, 0, 0, 0, 0, 0})));
  EXPECT_FALSE(end.plumb.receive(end.message));
  EXPECT_EQ(end.plumb.state(), LinkState::kUp);
  EXPECT_EQ(end.plumb.counters().reconnects, 1U);
}

TEST(CanPort, RefusesAnInterfaceThatIsNotThere) {
  const auto opening =
      CanPort::open("nocan9", layout_of(CanFrame::Format::kClassic), Sender::kPlumb);
  EXPECT_FALSE(opening.port);
  EXPECT_EQ(opening.step.grant, Grant::kDenied);
}

}  // namespace
}  // namespace plumb::drivers
