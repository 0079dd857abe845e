// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/bus_content.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/random_numbers.hpp"

namespace plumb::drivers {
namespace {

Transformd random_pose(tests::Random& random, double size_m, double size_rad) {
  const auto any = [&](double size) { return random.uniform(-size, size); };
  Transformd out = exp(format::Twist{.d = {}, .e = {any(size_rad), any(size_rad), any(size_rad)}});
  out.p = {any(size_m), any(size_m), any(size_m)};
  return out;
}

void expect_near(const Transformd& a, const Transformd& b) {
  EXPECT_NEAR((a.p - b.p).norm(), 0.0, 1e-12);
  EXPECT_NEAR((a.R - b.R).norm(), 0.0, 1e-12);
}

TEST(BusContent, PosesComeBack) {
  tests::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Transformd pose = random_pose(random, 3.0, 3.0);
    const BusMessage message = pose_message(MessageKind::kTarget, pose, 7);
    EXPECT_EQ(message.kind, MessageKind::kTarget);
    EXPECT_EQ(message.size, 6);
    EXPECT_EQ(message.counter, 7);
    expect_near(pose_in(message).value(), pose);
  }
}

TEST(BusContent, AQuarterTurnAboutZIsARotationVectorAlongZ) {
  Transformd pose = rot_z(std::acos(0.0));
  pose.p = {1.0, 2.0, 3.0};
  const BusMessage message = pose_message(MessageKind::kActual, pose, 0);
  const double wanted[] = {1.0, 2.0, 3.0, 0.0, 0.0, 1.5707963267948966};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(message.values[i], wanted[i], 1e-15);
}

TEST(BusContent, AnIncompletePoseIsNone) {
  for (std::size_t i = 0; i < 6; ++i) {
    BusMessage message = pose_message(MessageKind::kTarget, {}, 0);
    message.values[i] = NAN;
    EXPECT_FALSE(pose_in(message));
  }
  EXPECT_FALSE(pose_in(BusMessage{}));
}

TEST(BusContent, DesiredPlusOffsetIsCorrected) {
  tests::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Transformd desired = random_pose(random, 3.0, 3.0);
    Transformd corrected = random_pose(random, 0.003, 0.03);
    corrected = {.R = corrected.R * desired.R, .p = corrected.p + desired.p};
    expect_near(add_offset(desired, offset_message(desired, corrected, 3)), corrected);
  }
}

/// By hand: 1 mm along the base's x, and a turn of 10 mrad about the base's z, of a tool that looks
/// down.
TEST(BusContent, AnOffsetIsInTheBaseFrameWhateverTheToolsDirection) {
  Transformd desired = rot_x(std::acos(-1.0));
  desired.p = {0.5, 0.0, 0.2};
  Transformd corrected = rot_z(0.01) * rot_x(std::acos(-1.0));
  corrected.p = {0.501, 0.0, 0.2};
  const BusMessage offset = offset_message(desired, corrected, 3);
  const double wanted[] = {0.001, 0.0, 0.0, 0.0, 0.0, 0.01};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(offset.values[i], wanted[i], 1e-14);
}

TEST(BusContent, AnOffsetThatIsNotFiniteAddsNothing) {
  Transformd desired = rot_x(1.0);
  desired.p = {1.0, 2.0, 3.0};
  BusMessage offset = offset_message(desired, rot_x(1.01), 3);
  offset.values[4] = NAN;
  expect_near(add_offset(desired, offset), desired);
}

TEST(BusContent, JointsComeAsTheyAreAndNeverMoreThanAMessageHolds) {
  const std::array<double, 3> q{0.1, NAN, -3.0};
  const BusMessage message = joints_message(MessageKind::kJoints, q, 9);
  EXPECT_EQ(message.size, 3);
  EXPECT_EQ(message.values[2], -3.0);
  EXPECT_TRUE(std::isnan(message.values[1]));
  EXPECT_EQ(joints_message(MessageKind::kJoints, std::array<double, 20>{}, 9).size,
            kMaxMessageValues);
}

TEST(BusContent, ControllerStatesComeBackAndZeroIsNotReady) {
  const ControllerState ready{.drives_on = true,
                              .automatic = true,
                              .protective_stop = false,
                              .correction_enabled = true,
                              .acknowledge = false,
                              .tool = 1,
                              .frame = 2,
                              .payload = 255};
  const BusMessage message = controller_message(ready, 4);
  EXPECT_EQ(message.values[0], 1 + 2 + 8);
  const ControllerState back = controller_in(message);
  EXPECT_TRUE(back.drives_on && back.automatic && back.correction_enabled);
  EXPECT_FALSE(back.protective_stop || back.acknowledge);
  EXPECT_EQ(back.tool, 1);
  EXPECT_EQ(back.frame, 2);
  EXPECT_EQ(back.payload, 255);
  BusMessage zeros = message;
  zeros.values.fill(0.0);
  EXPECT_FALSE(controller_in(zeros).drives_on || controller_in(zeros).correction_enabled);
}

TEST(BusContent, AControllerStateThatCannotBeIsTheSafeSide) {
  const BusMessage good = controller_message(
      {.drives_on = true, .automatic = true, .protective_stop = false, .correction_enabled = true},
      4);
  for (const double bad : {double{NAN}, -1.0, 0.5, 256.0 * 65536.0, double{INFINITY}})
    for (std::size_t i = 0; i < 4; ++i) {
      BusMessage message = good;
      message.values[i] = bad;
      const ControllerState state = controller_in(message);
      EXPECT_FALSE(state.drives_on || state.automatic || state.correction_enabled ||
                   state.acknowledge);
      EXPECT_TRUE(state.protective_stop);
    }
  EXPECT_TRUE(controller_in(BusMessage{}).protective_stop);
}

TEST(BusContent, SessionStatesComeBack) {
  const SessionStatus sent{.state = SessionState::kActive,
                           .mode = CorrectionMode::kFull,
                           .status = Status::kNearSingular,
                           .has_output = true,
                           .refused = 65535,
                           .limited = 1,
                           .stale = 2};
  const SessionStatus back = status_in(status_message(sent, 1));
  EXPECT_EQ(back.state, sent.state);
  EXPECT_EQ(back.mode, sent.mode);
  EXPECT_EQ(back.status, sent.status);
  EXPECT_TRUE(back.has_output);
  EXPECT_EQ(back.refused, 65535);
  EXPECT_EQ(back.limited, 1);
  EXPECT_EQ(back.stale, 2);
}

TEST(BusContent, AStatusThatAsksForAnAcknowledgementComesBack) {
  const BusMessage asking =
      status_message({.state = SessionState::kFault, .status = Status::kStale, .asks = true}, 1);
  EXPECT_EQ(asking.values[2], 6.0) << "as docs/safety.md says";
  EXPECT_TRUE(status_in(asking).asks);
  EXPECT_EQ(status_in(asking).state, SessionState::kFault);
  EXPECT_FALSE(status_in(status_message({.status = Status::kOk}, 1)).asks);
}

TEST(BusContent, ASessionStateThatCannotBeIsInitWithoutOutput) {
  const BusMessage good = status_message(
      {.state = SessionState::kActive, .status = Status::kOk, .has_output = true}, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    BusMessage message = good;
    message.values[i] = 77.0;
    EXPECT_EQ(status_in(message).state, SessionState::kInit);
    EXPECT_FALSE(status_in(message).has_output);
  }
}

TEST(BusContent, FingerprintsAreExactOnTheBusAndNeverZero) {
  EXPECT_EQ(fingerprint("F08-1234"), 2925346U);  // worked out bit by bit elsewhere
  tests::Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const std::uint32_t number = fingerprint(std::to_string(random.bits()));
    ASSERT_GE(number, 1U);
    ASSERT_LE(number, 8388607U);
  }
  EXPECT_EQ(robot_message(2925346, 1).values[0], 2925346.0);
  EXPECT_EQ(signature_message(5, 6, 1).values[1], 6.0);
}

}  // namespace
}  // namespace plumb::drivers
