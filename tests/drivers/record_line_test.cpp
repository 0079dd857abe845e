// SPDX-License-Identifier: Apache-2.0
// Lines of a record: as candump -L of can-utils 2020.11 wrote them, and back.
#include "rt/record_line.hpp"

#include <gtest/gtest.h>

#include "plumb/drivers/session_sync.hpp"
#include "tests/drivers/session_rig.hpp"

namespace plumb::tests {
namespace {

using namespace drivers::rt;

TEST(RecordLine, IsWhatCandumpWrites) {
  const char* const lines[] = {
      "(1436509052.249713) vcan0 044#2A366C2BBA",
      "(0000000012.000001) can0 12345678#",
      "(1436509053.850870) vcan1 7FF##1112233445566778899AABBCC",
      "(1436509053.850870) vcan1 000#0011223344556677",
  };
  for (const char* const text : lines) {
    const auto line = parse_line(text);
    ASSERT_TRUE(line.has_value()) << text;
    EXPECT_EQ(to_line(*line), text);
  }
  EXPECT_EQ(parse_line(lines[0])->frame.time_ns, 1'436'509'052'249'713'000);
  EXPECT_EQ(parse_line(lines[0])->frame.length, 5);
  EXPECT_EQ(parse_line(lines[1])->frame.id_kind, CanFrame::Id::kExtended);
  EXPECT_EQ(parse_line(lines[2])->frame.format, CanFrame::Format::kFd);
  EXPECT_EQ(parse_line(lines[2])->frame.length, 12);
}

TEST(RecordLine, WhatIsNoneIsRefused) {
  for (const char* const text :
       {"", "(", "()", "(1.000000)", "(1.000000) can0", "(1.000000) can0 1", "(1.0) can0 123#",
        "(1.000000) can0 123#1", "(1.000000) can0 123#1G", "(-1.000000) can0 123#",
        "(1.000000) can0 123#112233445566778899", "(99999999999.000000) can0 1#",
        "(1.000000) can0 123##", "1.000000 can0 123#"})
    EXPECT_FALSE(parse_line(text).has_value()) << text;
}

TEST(RecordLine, ATickHoldsAllTheSessionWasTold) {
  const RecordedTick tick{.told = {.now_ns = 123'456'789'000,
                                   .foreign_senders = 0x01020304,
                                   .run = SessionTick::Run::kStop,
                                   .host = SessionTick::Host::kSlept,
                                   .peer = SessionTick::Peer::kRestarted,
                                   .answers = SessionTick::Answers::kRefused},
                          .model = 0x7FABCD};
  const auto line = parse_line(to_line({kTickName, tick_frame(tick)}));
  ASSERT_TRUE(line.has_value());
  const RecordedTick read = tick_in(line->frame);
  EXPECT_EQ(read.told.now_ns, tick.told.now_ns);
  EXPECT_EQ(read.told.foreign_senders, tick.told.foreign_senders);
  EXPECT_EQ(read.model, tick.model);
  EXPECT_EQ(read.told.run, tick.told.run);
  EXPECT_EQ(read.told.host, tick.told.host);
  EXPECT_EQ(read.told.peer, tick.told.peer);
  EXPECT_EQ(read.told.answers, tick.told.answers);
}

TEST(RecordLine, AStartHoldsWhatTheRunsBeforeLeft) {
  const SessionStart start{.fault = FaultCause::kOtherRobot,
                           .acknowledgement = SessionStart::Acknowledgement::kNeeded};
  const auto line = parse_line(to_line({kStartName, start_frame(start, 5'000)}));
  ASSERT_TRUE(line.has_value());
  EXPECT_EQ(start_in(line->frame).fault, start.fault);
  EXPECT_EQ(start_in(line->frame).acknowledgement, start.acknowledgement);
  EXPECT_EQ(start_in(CanFrame{}).fault, FaultCause::kNone);
}

TEST(SyncCheck, ComparesAPoseWithTheJointsOfItsCounterOnly) {
  const auto model = loaded();
  const Chain& nominal = model->corrector().nominal();
  SyncCheck check({});
  const auto joints_at = [](int i) {
    return std::vector<double>{0.11 * i, -1.0, 1.2, -0.4, 1.1, 0.2};
  };
  for (int i = 0; i < 100; ++i) {
    auto joints = joints_message(MessageKind::kJoints, joints_at(i), static_cast<std::uint16_t>(i));
    joints.time_ns = i * 4'000'000;
    check.hear(joints, nominal);
    if (i < 3) continue;
    const Transformd X_BA = nominal.forward(joints_at(i - 3));  // the pose comes 12 ms later
    auto actual = pose_message(MessageKind::kActual, X_BA, static_cast<std::uint16_t>(i - 3));
    actual.time_ns = i * 4'000'000;
    check.hear(actual, nominal);
  }
  EXPECT_EQ(check.counters().compared, 97U);
  EXPECT_EQ(check.counters().mismatched, 0U);
  EXPECT_EQ(check.counters().distinct, kMostDistinct);
  EXPECT_TRUE(check.agreed());
  auto alone = pose_message(MessageKind::kActual, nominal.forward(joints_at(0)), 5000);
  check.hear(alone, nominal);
  EXPECT_EQ(check.counters().compared, 97U);
}

TEST(SyncCheck, StandingStillAgreesAndSaysHowLittleThatIsWorth) {
  const auto model = loaded();
  const Chain& nominal = model->corrector().nominal();
  const std::vector<double> q{0.1, -1.0, 1.2, -0.4, 1.1, 0.2};
  SyncCheck check({.distinct = 1});
  for (std::uint16_t i = 0; i < 60; ++i) {
    check.hear(joints_message(MessageKind::kJoints, q, i), nominal);
    check.hear(pose_message(MessageKind::kActual, nominal.forward(q), i), nominal);
  }
  EXPECT_TRUE(check.agreed());
  EXPECT_EQ(check.counters().distinct, 1);
  Transformd turned = nominal.forward(q);
  turned.R = (rot_z(60e-6) * Transformd{.R = turned.R, .p = Vector3::Zero()}).R;
  for (std::uint16_t i = 60; i < 63; ++i) {
    check.hear(joints_message(MessageKind::kJoints, q, i), nominal);
    check.hear(pose_message(MessageKind::kActual, turned, i), nominal);
  }
  EXPECT_TRUE(check.mismatched());
  EXPECT_NEAR(check.counters().last_rad, 60e-6, 1e-9);
}

}  // namespace
}  // namespace plumb::tests
