// SPDX-License-Identifier: Apache-2.0
// What a Modbus link makes of peers that are silent, go, come back or are two.
#include <gtest/gtest.h>

#include "tests/drivers/modbus_pair.hpp"
#include "tests/drivers/pty_pair.hpp"

namespace plumb::tests {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// A controller need not send every message of the layout, and comes when it comes.
void expect_clean_without(MessageKind kind, Pair& pair) {
  ASSERT_FALSE(pair.fault) << words(pair.fault);
  pair.far.silent = kind;
  ASSERT_TRUE(soon([&] {
    pair.cycle();
    return pair.near.heard > 200;
  }));
  EXPECT_FALSE(pair.near.newest(kind));
  EXPECT_EQ(pair.near.port.state(), LinkState::kUp);
  EXPECT_EQ(pair.near.port.counters().corrupt, 0U);
  EXPECT_EQ(pair.near.port.counters().reconnects, 0U);
}

TEST(ModbusLinkFaults, AMessageThatIsNeverSentIsNotTakenForACorruptOne) {
  BusLayout layout = default_layout(6, 0.001);
  for (auto& message : layout.messages) message.period_s = 0.001;
  Pair pair(layout, kAnyPort, {}, Sender::kPlumb);
  ASSERT_FALSE(pair.client.start());
  expect_clean_without(MessageKind::kContext, pair);
}

TEST(ModbusLinkFaults, OnASerialCableWaitingForTheFirstAnswerIsNoReconnection) {
  PtyPair cable;
  const ModbusServerSettings at{.at = SerialLine{.device = cable.device(0)}};
  ModbusClientSettings to{.server = SerialLine{.device = cable.device(1)},
                          .response_timeout_s = 0.2};
  cable.cut();
  Pair pair(default_layout(6, 0.004), at, to, Sender::kPlumb);
  ASSERT_FALSE(pair.client.start());
  ASSERT_TRUE(soon([&] { return pair.client.exchange().counters.timeouts >= 3U; }));
  EXPECT_EQ(pair.client.exchange().counters.connects, 0U);
  cable.mend();
  expect_clean_without(MessageKind::kContext, pair);
}

TEST(ModbusLinkFaults, WhatTheServerWithdrewAsOldIsNotTakenForCorrupt) {
  BusLayout layout = default_layout(6, 0.001);
  for (auto& message : layout.messages) message.period_s = 0.001;
  Pair pair(layout, kAnyPort, {}, Sender::kPlumb);
  ASSERT_FALSE(pair.fault) << words(pair.fault);
  ASSERT_FALSE(pair.client.start());
  ASSERT_TRUE(soon([&] {
    pair.cycle();
    return pair.near.heard > 50;
  }));
  ASSERT_TRUE(soon([&] { return pair.server.exchange().counters.stale > 3U; }));
  const std::uint64_t before = pair.client.exchange().counters.transactions;
  ASSERT_TRUE(soon([&] { return pair.client.exchange().counters.transactions > before + 10; }));
  EXPECT_EQ(pair.client.exchange().counters.corrupt, 0U);
}

TEST(ModbusLinkFaults, APeerThatGoesAndComesBackIsFoundAgain) {
  const BusLayout layout = default_layout(6, 0.001);
  auto server =
      std::make_unique<ModbusServer>(layout, Pair::with_self(kAnyPort, Sender::kController));
  ASSERT_FALSE(server->start());
  const std::uint16_t port = server->port();
  ModbusClient client(layout, {.server = TcpAddress{"127.0.0.1", port}});
  ASSERT_FALSE(client.start());
  Talker near(client.exchange(), layout, Sender::kPlumb);
  for (int turn = 0; turn < 3; ++turn) {
    Talker far(server->exchange(), layout, Sender::kController);
    const int before = near.heard;
    const auto begin = Clock::now();
    ASSERT_TRUE(soon([&] {
      far.cycle();
      near.cycle();
      return near.heard > before + 20;
    }));
    std::printf("back after %.0f ms\n", 1e3 * seconds_since(begin));
    EXPECT_LT(seconds_since(begin), 3.0);
    server.reset();
    ASSERT_TRUE(soon([&] { return near.port.state() == LinkState::kDown; }));
    EXPECT_FALSE(near.port.send(lawful(layout, MessageKind::kCorrected, 1)));
    server = std::make_unique<ModbusServer>(
        layout, ModbusServerSettings{.at = TcpAddress{"127.0.0.1", port},
                                     .peers = {"127.0.0.1"},
                                     .self = Sender::kController});
    std::this_thread::sleep_for(300ms);
    const auto fault = server->start();
    ASSERT_FALSE(fault) << words(fault);
  }
  EXPECT_EQ(near.unlawful, 0);
  EXPECT_GE(near.port.counters().reconnects, 2U);
}

TEST(ModbusLinkFaults, WhatWaitedWhileThePeerWasGoneIsNotWrittenWhenItComesBack) {
  const BusLayout layout = default_layout(6, 0.001);
  ModbusServer server(layout, Pair::with_self(kAnyPort, Sender::kController));
  ASSERT_FALSE(server.start());
  ModbusClient client(layout, {.server = TcpAddress{"127.0.0.1", server.port()}});
  ModbusPort port(client.exchange(), layout, Sender::kPlumb);
  EXPECT_FALSE(port.send(lawful(layout, MessageKind::kCorrected, 77)));  // not even started
  std::this_thread::sleep_for(150ms);
  ASSERT_FALSE(client.start());
  ASSERT_TRUE(
      soon([&] { return port.state() == LinkState::kUp || port.state() == LinkState::kDegraded; }));
  ASSERT_TRUE(soon([&] { return client.exchange().counters.stale == 1U; }));
  Talker far(server.exchange(), layout, Sender::kController);
  far.cycle();
  EXPECT_FALSE(far.newest(MessageKind::kCorrected));
}

TEST(ModbusLinkFaults, ACutCableIsSeenAndMended) {
  PtyPair cable;
  const ModbusServerSettings at{.at = SerialLine{.device = cable.device(0)}};
  ModbusClientSettings to{.server = SerialLine{.device = cable.device(1)}};
  Pair pair(default_layout(6, 0.01), at, to, Sender::kPlumb);
  ASSERT_FALSE(pair.fault) << words(pair.fault);
  ASSERT_FALSE(pair.client.start());
  const auto talks = [&](int more) {
    const int goal = pair.near.heard + more;
    return soon([&] {
      pair.cycle();
      return pair.near.heard >= goal;
    });
  };
  ASSERT_TRUE(talks(20));
  cable.cut();
  ASSERT_TRUE(soon([&] {
    pair.cycle();
    return pair.near.port.state() == LinkState::kDown;
  }));
  cable.mend();
  ASSERT_TRUE(talks(20));
  EXPECT_EQ(pair.near.unlawful, 0);
  EXPECT_EQ(pair.far.unlawful, 0);
}

TEST(ModbusLinkFaults, AClientThatFindsAnotherInItsRegistersWritesNothing) {
  const BusLayout layout = default_layout(6, 0.001);
  ModbusServer server(layout, Pair::with_self(kAnyPort, Sender::kController));
  ASSERT_FALSE(server.start());
  ModbusClient first(layout, {.server = TcpAddress{"127.0.0.1", server.port()}});
  ModbusClient second(layout, {.server = TcpAddress{"127.0.0.1", server.port()}});
  Talker a(first.exchange(), layout, Sender::kPlumb), b(second.exchange(), layout, Sender::kPlumb);
  const auto comes = [&](const std::function<bool()>& what) {
    return soon([&] {
      a.cycle();
      b.cycle();
      return what();
    });
  };
  ASSERT_FALSE(first.start());
  ASSERT_TRUE(comes([&] { return first.exchange().counters.sent > 20U; }));
  ASSERT_FALSE(second.start());
  EXPECT_TRUE(comes([&] { return second.exchange().counters.foreign_senders > 20U; }));
  EXPECT_EQ(second.exchange().counters.sent, 0U);
  EXPECT_EQ(first.exchange().counters.foreign_senders, 0U);
  EXPECT_EQ(server.exchange().counters.foreign_senders, 0U);
  first.stop();
  EXPECT_TRUE(comes([&] { return second.exchange().counters.sent > 20U; })) << "they rest now";
}

}  // namespace
}  // namespace plumb::tests
