// SPDX-License-Identifier: Apache-2.0
#include "rt/csv_port.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

#include "plumb/drivers/bus_content.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr std::uint32_t kRobot = 4711;

std::vector<CsvTarget> some_rows(int count) {
  std::vector<CsvTarget> out(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    CsvTarget& row = out[static_cast<std::size_t>(i)];
    row.q = {0.1 * i, -1.0, 1.2, -0.4, 1.1, 0.2};
    row.X_BD.p = Vector3(0.001 * i, 0.5, 0.25);
  }
  return out;
}

/// One cycle: what is received before the port says that there is no more.
std::map<MessageKind, BusMessage> cycle_of(CsvPort& port) {
  std::map<MessageKind, BusMessage> out;
  for (BusMessage message; port.receive(message);) {
    EXPECT_FALSE(out.contains(message.kind)) << "each message once a cycle";
    out[message.kind] = message;
  }
  return out;
}

class CsvPorts : public testing::Test {
 protected:
  static BusLayout layout() {
    BusLayout out = default_layout(6, 0.001);
    out.can_format = CanFrame::Format::kFd;
    return out;
  }
  const std::unique_ptr<const LoadedModel> model = LoadedModel::make(tests::one_arm(), 1);
};

TEST_F(CsvPorts, EveryRowIsPlayedOnceInItsOrderAfterTheLeadAndTheLastOneGoesOn) {
  for (const int lead : {0, 1, 7})
    for (const int rows : {1, 2, 5}) {
      CsvPort port(some_rows(rows), *model, kRobot, layout(), lead);
      for (int cycle = 0; cycle < lead + rows + 3; ++cycle) {
        EXPECT_EQ(port.finished(), cycle >= lead + rows) << lead << " " << rows << " " << cycle;
        const auto heard = cycle_of(port);
        ASSERT_TRUE(heard.contains(MessageKind::kTarget));
        const int row = std::clamp(cycle - lead, 0, rows - 1);
        EXPECT_NEAR(heard.at(MessageKind::kTarget).values[0], 0.001 * row, 1e-6);
        EXPECT_NEAR(heard.at(MessageKind::kJoints).values[0], 0.1 * row, 1e-5);
      }
    }
}

TEST_F(CsvPorts, TheMessagesOfACycleHaveOneCounterAndThoseOfTheNextTheNext) {
  CsvPort port(some_rows(3), *model, kRobot, layout(), 2);
  for (int cycle = 0; cycle < 70'000; ++cycle) {  // more than the counter has numbers
    const auto heard = cycle_of(port);
    for (const auto& [kind, message] : heard)
      ASSERT_EQ(message.counter, static_cast<std::uint16_t>(cycle)) << name_of(kind);
  }
}

/// The controller that it stands for is one for which a session corrects at once.
TEST_F(CsvPorts, ItsControllerIsReadyItsRobotIsTheOneToldAndItsPoseIsThatOfItsJoints) {
  CsvPort port(some_rows(1), *model, kRobot, layout(), 0);
  const auto heard = cycle_of(port);
  const ControllerState state = controller_in(heard.at(MessageKind::kController));
  EXPECT_TRUE(state.drives_on && state.automatic && state.correction_enabled);
  EXPECT_FALSE(state.protective_stop || state.acknowledge);
  EXPECT_EQ(heard.at(MessageKind::kRobot).values[0], kRobot);
  const auto X_BN = pose_in(heard.at(MessageKind::kActual));
  ASSERT_TRUE(X_BN);
  const Transformd own = Chain(tests::one_arm().nominal).forward(some_rows(1)[0].q);
  EXPECT_LT((X_BN->p - own.p).norm(), 2e-6);
  EXPECT_LT((X_BN->R - own.R).norm(), 2e-6);
}

/// A record holds frames: what they cannot carry must not have been computed with.
TEST_F(CsvPorts, WhatIsHeardComesThroughFramesWithoutAnyChange) {
  CsvPort port(some_rows(4), *model, kRobot, layout(), 0);
  CanCodec to(layout()), from(layout());
  for (int cycle = 0; cycle < 4; ++cycle)
    for (const auto& [kind, message] : cycle_of(port)) {
      BusMessage again;
      Heard heard = Heard::kNotOurs;
      for (const CanFrame& frame : to.encode(message)) heard = from.hear(frame, again);
      ASSERT_EQ(heard, Heard::kComplete) << name_of(kind);
      for (std::size_t i = 0; i < message.size; ++i)
        EXPECT_EQ(again.values[i], message.values[i]) << name_of(kind) << " " << i;
    }
}

TEST_F(CsvPorts, WhatTheLayoutDoesNotHaveIsLeftOutAndTheRestComes) {
  BusLayout small = layout();
  std::erase_if(small.messages,
                [](const MessageLayout& m) { return m.kind == MessageKind::kRobot; });
  CsvPort port(some_rows(2), *model, kRobot, small, 0);
  const auto heard = cycle_of(port);
  EXPECT_FALSE(heard.contains(MessageKind::kRobot));
  EXPECT_TRUE(heard.contains(MessageKind::kTarget));
  EXPECT_TRUE(heard.contains(MessageKind::kController));
  EXPECT_EQ(port.counters().received, heard.size());
}

}  // namespace
}  // namespace plumb::drivers::rt
