// SPDX-License-Identifier: Apache-2.0
// Client and server against each other, over TCP on this machine and over a serial cable.
#include <gtest/gtest.h>

#include "tests/drivers/modbus_pair.hpp"
#include "tests/drivers/pty_pair.hpp"

namespace plumb::tests {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

void expect_talk(Pair& pair, Sender client_is) {
  const Sender other = client_is == Sender::kPlumb ? Sender::kController : Sender::kPlumb;
  ASSERT_FALSE(pair.fault) << words(pair.fault);
  const auto fault = pair.client.start();
  ASSERT_FALSE(fault) << words(fault);
  EXPECT_TRUE(soon([&] {
    pair.cycle();
    return all_of_the_other_side_heard(pair.layout, pair.near, other) &&
           all_of_the_other_side_heard(pair.layout, pair.far, client_is) && pair.near.heard > 100;
  }));
  EXPECT_EQ(pair.near.unlawful, 0);
  EXPECT_EQ(pair.far.unlawful, 0);
  EXPECT_EQ(pair.near.port.state(), LinkState::kUp);
  EXPECT_EQ(pair.far.port.state(), LinkState::kUp);
  EXPECT_EQ(pair.client.exchange().counters.corrupt, 0U);
  EXPECT_EQ(pair.client.exchange().counters.foreign_senders, 0U);
}

class ModbusLink : public testing::TestWithParam<Sender> {};
INSTANTIATE_TEST_SUITE_P(BothRoles, ModbusLink,
                         testing::Values(Sender::kPlumb, Sender::kController));

TEST_P(ModbusLink, CarriesEveryMessageOverTcp) {
  Pair pair(default_layout(6, 0.001), kAnyPort, {}, GetParam());
  expect_talk(pair, GetParam());
}

TEST_P(ModbusLink, CarriesEveryMessageOverASerialCable) {
  PtyPair cable;
  const ModbusServerSettings at{.at = SerialLine{.device = cable.device(0)}};
  ModbusClientSettings to{.server = SerialLine{.device = cable.device(1)}};
  Pair pair(default_layout(6, 0.01), at, to, GetParam());
  expect_talk(pair, GetParam());
}

TEST_P(ModbusLink, CarriesTheOtherWordOrderAndSevenJoints) {
  BusLayout layout = default_layout(7, 0.002, 2);
  layout.word_order = ByteOrder::kLittle;
  Pair pair(layout, kAnyPort, {}, GetParam());
  expect_talk(pair, GetParam());
}

/// Shared machines stall: the best of several seconds counts.
TEST(ModbusLinkRate, RunsAThousandCyclesASecondOnOneMachine) {
  ModbusClientSettings to;
  to.poll_period_s = 100e-6;
  Pair pair(default_layout(6, 0.001), kAnyPort, to, Sender::kPlumb);
  ASSERT_FALSE(pair.client.start());
  double best = 0;
  double best_requests = 0;
  for (int attempt = 0; attempt < (PLUMB_TIMED ? 5 : 1) && best < 1000; ++attempt) {
    const auto begin = Clock::now();
    const std::uint64_t requests = pair.client.exchange().counters.transactions;
    int round_trips = 0;  // a target that came, and its answer that arrived
    std::uint16_t answered = 0;
    while (seconds_since(begin) < 1.0) {
      pair.far.cycle();
      const std::uint16_t asked = pair.far.counter;
      soon(
          [&] {
            BusMessage target;
            while (pair.near.port.receive(target))
              if (target.kind == MessageKind::kTarget)
                pair.near.port.send(lawful(pair.layout, MessageKind::kCorrected, target.counter));
            while (pair.far.port.receive(target))
              if (target.kind == MessageKind::kCorrected) answered = target.counter;
            return answered == asked;
          },
          100ms);
      if (answered == asked) ++round_trips;
    }
    best = std::max(best, round_trips / seconds_since(begin));
    best_requests =
        std::max(best_requests,
                 static_cast<double>(pair.client.exchange().counters.transactions - requests) /
                     seconds_since(begin));
  }
  std::printf("%.0f round trips/s, %.0f requests/s\n", best, best_requests);
  const double mark = PLUMB_TIMED ? 1000 : 1;  // sanitizers slow every access
  EXPECT_GE(best_requests, mark);
  EXPECT_GE(best, mark);
}

}  // namespace
}  // namespace plumb::tests
