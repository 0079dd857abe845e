// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_link.hpp"

#include <gtest/gtest.h>
#include <linux/can/error.h>

#include <cerrno>
#include <random>
#include <set>

#include "plumb/drivers/time_source.hpp"
#include "tests/drivers/socket_pair.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::drivers {
namespace {

using tests::classic;
using tests::fd;
using tests::SocketPair;

constexpr CanLinkOptions kClassicLink = {};
constexpr CanLinkOptions kFdLink = {.format = CanFrame::Format::kFd};

/// A link, and the far end of its bus.
struct Wire {
  explicit Wire(CanLinkOptions options = kClassicLink, int type = SOCK_SEQPACKET)
      : far(type), link(far.link_end(), options) {}

  /// Whether a data frame came out.
  bool receives() { return link.receive(frame); }

  SocketPair far;
  CanLink link;
  CanFrame frame;
};

CanFrame frame_of(std::uint8_t length, CanFrame::Format format) {
  CanFrame out{.id = 0x123, .format = format, .length = length};
  for (std::size_t i = 0; i < length; ++i) out.data[i] = static_cast<std::uint8_t>(i + 1);
  return out;
}

can_frame error(std::uint32_t classes, std::uint8_t controller = 0) {
  return classic(CAN_ERR_FLAG | classes, {0, controller, 0, 0, 0, 0, 0, 0});
}

TEST(CanLink, WritesTheStructOfTheKernel) {
  Wire wire;
  EXPECT_TRUE(wire.link.send({.id = 0x123, .length = 2, .data = {0xDE, 0xAD}}));
  // can_id little-endian on the machines we run on, length, three bytes of padding, data
  EXPECT_EQ(wire.far.take(),
            (std::vector<std::uint8_t>{0x23, 1, 0, 0, 2, 0, 0, 0, 0xDE, 0xAD, 0, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(wire.link.send({.id = 0x1F334455, .id_kind = CanFrame::Id::kExtended}));
  EXPECT_EQ(wire.far.take()[3], 0x9F);  // bit 31 marks 29 bits
  EXPECT_EQ(wire.link.counters().sent, 2U);
}

TEST(CanLink, WritesAnFdFrameOfSeventyTwoBytesWithBitRateSwitch) {
  Wire wire(kFdLink);
  EXPECT_TRUE(wire.link.send(frame_of(12, CanFrame::Format::kFd)));
  const auto bytes = wire.far.take();
  ASSERT_EQ(bytes.size(), 72U);
  EXPECT_EQ(bytes[4], 12);
  EXPECT_EQ(bytes[5], 1);  // CANFD_BRS
  Wire slow({.format = CanFrame::Format::kFd, .data_phase = CanLinkOptions::DataPhase::kOneRate});
  EXPECT_TRUE(slow.link.send(frame_of(12, CanFrame::Format::kFd)));
  EXPECT_EQ(slow.far.take()[5], 0);
}

TEST(CanLink, SendsOnlyLengthsThatAFrameCanHave) {
  const std::set<int> fd_lengths = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  Wire wire(kFdLink, SOCK_DGRAM);
  for (int length = 0; length < 256; ++length) {
    CanFrame frame{.id = 1, .length = static_cast<std::uint8_t>(length)};
    EXPECT_EQ(wire.link.send(frame), length <= 8) << length;
    frame.format = CanFrame::Format::kFd;
    EXPECT_EQ(wire.link.send(frame), fd_lengths.contains(length)) << length;
    while (!wire.far.take().empty()) {
    }
  }
  EXPECT_EQ(wire.link.counters().sent, 9U + 16U);
  EXPECT_EQ(wire.link.counters().not_sent, 512U - 25U);
}

TEST(CanLink, SendsNoIdentifierOutOfRangeAndNoFdFrameOnAClassicLink) {
  Wire wire;
  EXPECT_FALSE(wire.link.send({.id = 0x800}));
  EXPECT_FALSE(wire.link.send({.id = 0x20000000, .id_kind = CanFrame::Id::kExtended}));
  EXPECT_FALSE(wire.link.send(frame_of(8, CanFrame::Format::kFd)));
  EXPECT_TRUE(wire.far.take().empty());
  EXPECT_EQ(wire.link.counters().not_sent, 3U);
}

TEST(CanLink, ReceivesWhatIsThereInOrderThenNothing) {
  Wire wire(kFdLink);
  ASSERT_TRUE(wire.far.put(classic(0x123, {1, 2, 3})));
  ASSERT_TRUE(wire.far.put(fd(0x456 | CAN_EFF_FLAG, 64, 0xAB)));
  ASSERT_TRUE(wire.receives());
  EXPECT_EQ(wire.frame.id, 0x123U);
  EXPECT_EQ(wire.frame.format, CanFrame::Format::kClassic);
  EXPECT_EQ(wire.frame.length, 3);
  EXPECT_EQ(wire.frame.data[2], 3);
  ASSERT_TRUE(wire.receives());
  EXPECT_EQ(wire.frame.id, 0x456U);
  EXPECT_EQ(wire.frame.id_kind, CanFrame::Id::kExtended);
  EXPECT_EQ(wire.frame.format, CanFrame::Format::kFd);
  EXPECT_EQ(wire.frame.data[63], 0xAB);
  EXPECT_FALSE(wire.receives());
  EXPECT_EQ(wire.link.counters().received, 2U);
}

TEST(CanLink, LeavesNoBytesOfAnEarlierFrameBehindTheData) {
  Wire wire(kFdLink);
  ASSERT_TRUE(wire.far.put(fd(1, 64, 0xFF)));
  ASSERT_TRUE(wire.far.put(classic(1, {7})));
  ASSERT_TRUE(wire.receives());
  ASSERT_TRUE(wire.receives());
  EXPECT_EQ(wire.frame.data[0], 7);
  for (std::size_t i = 1; i < CanFrame::kMostBytes; ++i) EXPECT_EQ(wire.frame.data[i], 0);
}

TEST(CanLink, CountsWhatIsNoDataFrame) {
  Wire wire;
  const std::array<std::uint8_t, 100> zeros = {};
  for (const std::size_t size : {1U, 15U, 17U, 72U, 73U, 100U})
    ASSERT_TRUE(wire.far.put_bytes(zeros.data(), size));
  can_frame nine = classic(1, {});
  nine.can_dlc = 9;
  ASSERT_TRUE(wire.far.put(nine));
  ASSERT_TRUE(wire.far.put(classic(0x800, {})));  // 12 bits, and not marked as extended
  EXPECT_FALSE(wire.receives());
  EXPECT_EQ(wire.link.counters().malformed, 8U);
  ASSERT_TRUE(wire.far.put(classic(0x123 | CAN_RTR_FLAG, {})));
  EXPECT_FALSE(wire.receives());
  EXPECT_EQ(wire.link.counters().remote, 1U);
  EXPECT_EQ(wire.link.counters().received, 0U);
}

TEST(CanLink, RefusesFdLengthsInBetweenAndRemoteFdFrames) {
  Wire wire(kFdLink);
  for (const int length : {9, 13, 25, 40, 63, 65, 255})
    ASSERT_TRUE(wire.far.put(fd(1, static_cast<std::uint8_t>(length), 0)));
  ASSERT_TRUE(wire.far.put(fd(1 | CAN_RTR_FLAG, 8, 0)));
  ASSERT_TRUE(wire.far.put(fd(1 | CAN_ERR_FLAG, 8, 0)));
  EXPECT_FALSE(wire.receives());
  EXPECT_EQ(wire.link.counters().malformed, 9U);
  EXPECT_EQ(wire.link.state(), LinkState::kUp);
}

TEST(CanLink, SurvivesRandomDatagramsAndOnlyLetsFramesThrough) {
  const long count = tests::scaled(20'000);
  const unsigned seed = 7;
  std::printf("%ld datagrams, seed %u\n", count, seed);
  std::mt19937 random(seed);
  Wire wire(kFdLink, SOCK_DGRAM);
  std::array<std::uint8_t, 80> bytes = {};
  long passed = 0;
  for (long i = 0; i < count; ++i) {
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    bytes[4] = static_cast<std::uint8_t>(random() % 80);
    const std::size_t size =
        std::array<std::size_t, 4>{16, 72, 16, 1 + random() % 80}[random() % 4];
    ASSERT_TRUE(wire.far.put_bytes(bytes.data(), size));
    if (!wire.receives()) continue;
    ++passed;
    ASSERT_TRUE(size == 16 || size == 72);
    ASSERT_LE(wire.frame.length, size == 16 ? 8 : 64);
    ASSERT_LE(wire.frame.id, wire.frame.id_kind == CanFrame::Id::kExtended ? 0x1FFFFFFFU : 0x7FFU);
  }
  EXPECT_GT(passed, 0);
  EXPECT_GT(wire.link.counters().malformed, 0U);
}

TEST(CanLink, DoesNotLookAtMoreThanItSaysInOneCall) {
  Wire wire(kClassicLink, SOCK_STREAM);  // a stream: one write is many reads of 72 bytes
  const std::vector<std::uint8_t> flood(72 * 1000);
  ASSERT_TRUE(wire.far.put_bytes(flood.data(), flood.size()));
  EXPECT_FALSE(wire.receives());
  EXPECT_EQ(wire.link.counters().malformed, static_cast<unsigned>(CanLink::kMostFramesACall));
}

TEST(CanLink, CountsWhatFindsNoRoom) {
  Wire wire(kClassicLink, SOCK_DGRAM);
  int sent = 0;
  while (sent < 100'000 && wire.link.send({.id = 1})) ++sent;
  EXPECT_LT(sent, 100'000);
  EXPECT_EQ(wire.link.counters().not_sent, 1U);
  EXPECT_EQ(wire.link.state(), LinkState::kUp);  // busy, but nothing says that it is broken
  EXPECT_FALSE(wire.far.take().empty());
  EXPECT_TRUE(wire.link.send({.id = 1}));
}

TEST(CanLink, IsDownWhenTheOtherEndIsGone) {
  Wire wire;
  wire.far.hang_up();
  EXPECT_FALSE(wire.receives());
  EXPECT_EQ(wire.link.state(), LinkState::kDown);
  EXPECT_FALSE(wire.link.send({.id = 1}));
  EXPECT_EQ(wire.link.counters().not_sent, 1U);
  EXPECT_EQ(wire.link.errors().interface_downs, 1U);
}

TEST(CanLink, FollowsTheControllerFromWarningToBusOffAndBack) {
  Wire wire;
  const auto state_after = [&](const can_frame& frame) {
    EXPECT_TRUE(wire.far.put(frame));
    EXPECT_FALSE(wire.receives());
    return wire.link.state();
  };
  EXPECT_EQ(state_after(error(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING)), LinkState::kDegraded);
  EXPECT_EQ(state_after(error(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE)), LinkState::kDegraded);
  EXPECT_EQ(state_after(error(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE)), LinkState::kUp);
  EXPECT_EQ(state_after(error(CAN_ERR_BUSOFF)), LinkState::kDown);
  EXPECT_FALSE(wire.link.send({.id = 1}));
  EXPECT_TRUE(wire.far.take().empty());
  EXPECT_EQ(state_after(error(CAN_ERR_RESTARTED)), LinkState::kUp);
  EXPECT_TRUE(wire.link.send({.id = 1}));
  EXPECT_EQ(wire.link.reconnects(), 1U);
  EXPECT_EQ(state_after(error(CAN_ERR_LOSTARB | CAN_ERR_TX_TIMEOUT | CAN_ERR_ACK)), LinkState::kUp);
  const CanErrorCounters& errors = wire.link.errors();
  EXPECT_EQ(errors.warnings, 1U);
  EXPECT_EQ(errors.passives, 1U);
  EXPECT_EQ(errors.bus_offs, 1U);
  EXPECT_EQ(errors.restarts, 1U);
  EXPECT_EQ(errors.arbitration_lost, 1U);
  EXPECT_EQ(errors.transmit_timeouts, 1U);
  EXPECT_EQ(errors.not_acknowledged, 1U);
}

TEST(CanLink, IsUpAgainWithAFrameFromTheWire) {
  Wire wire;
  ASSERT_TRUE(wire.far.put(error(CAN_ERR_BUSOFF)));
  ASSERT_TRUE(wire.far.put(classic(1, {})));
  EXPECT_TRUE(wire.receives());
  EXPECT_EQ(wire.link.state(), LinkState::kUp);
}

TEST(CanLink, CountsWhatTheControllerLostAsOverflow) {
  Wire wire;
  ASSERT_TRUE(wire.far.put(error(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW)));
  EXPECT_FALSE(wire.receives());
  EXPECT_EQ(wire.link.counters().overflowed, 1U);
  EXPECT_EQ(wire.link.state(), LinkState::kUp);
}

TEST(CanLink, SaysOfAFrameWithoutAStampThatItIsAsOldAsItCanBe) {
  Wire wire;
  EXPECT_FALSE(wire.receives());
  const std::int64_t after_empty_ns = MonotonicTime::now_ns();
  ASSERT_TRUE(wire.far.put(classic(1, {})));
  ::usleep(2000);
  ASSERT_TRUE(wire.receives());
  EXPECT_LE(wire.frame.time_ns, after_empty_ns);
}

TEST(CanLink, RefusesAnInterfaceThatIsNotThere) {
  for (const char* name : {"nocan9", "", "a_name_longer_than_fifteen"}) {
    const CanOpening opening = CanLink::open(name, {}, {});
    EXPECT_FALSE(opening.link);
    EXPECT_EQ(opening.step.grant, Grant::kDenied);
    const Finding said = describe(opening.step);
    if (opening.step.kind == CanStepKind::kSocket) {  // this kernel has no CAN
      EXPECT_EQ(said.remedy, "sudo modprobe can_raw");
      continue;
    }
    EXPECT_EQ(opening.step.kind, CanStepKind::kInterface);
    EXPECT_EQ(opening.step.error, ENODEV);
  }
}

}  // namespace
}  // namespace plumb::drivers
