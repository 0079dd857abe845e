// SPDX-License-Identifier: Apache-2.0
// The session from message to message, in scripted time.
#include <gtest/gtest.h>

#include "tests/drivers/session_rig.hpp"

namespace plumb::tests {
namespace {

using enum SessionState;

SessionSettings in_mode(CorrectionMode mode) {
  SessionSettings out;
  out.mode = mode;
  return out;
}

TEST(Session, SendsNothingButStatusAndSignatureInShadow) {
  SessionRig rig;
  ASSERT_TRUE(rig.run_to(kShadow));
  int status = 0, signature = 0;
  for (int i = 0; i < 500; ++i) {
    const SessionOutput out = rig.cycle();
    for (const auto& message : out.sent()) {
      status += message.kind == MessageKind::kStatus ? 1 : 0;
      signature += message.kind == MessageKind::kSignature ? 1 : 0;
      if (message.kind != MessageKind::kStatus) continue;
      EXPECT_FALSE(status_in(message).has_output);
    }
  }
  EXPECT_EQ(rig.session->state(), kShadow);
  EXPECT_EQ(rig.answers, 0);
  EXPECT_NEAR(status, 100, 1);                      // every 20 ms of 2 s
  EXPECT_NEAR(signature, 10, 1);                    // every 200 ms
  EXPECT_GT(rig.session->report().wanted_m, 1e-4);  // it computes all the same
  EXPECT_EQ(rig.session->report().applied_m, 0.0);
}

TEST(Session, ComparesFiftyPosesBeforeAnythingElse) {
  SessionSettings settings = in_mode(CorrectionMode::kFull);
  settings.sync.distinct = 1;
  SessionRig rig(settings);
  rig.run(49);  // the first goes INIT -> SYNC, and its pose counts
  EXPECT_EQ(rig.session->state(), kSync);
  rig.run(1);
  EXPECT_EQ(rig.session->state(), kShadow);
  EXPECT_EQ(rig.session->report().sync.agreed, 50);
  EXPECT_EQ(rig.answers, 0);
}

TEST(Session, ComparesDistinctPosesSoThatAnArmAtRestIsNotCorrected) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  rig.swings = false;
  rig.run(2000);
  EXPECT_EQ(rig.session->state(), kSync) << "one pose is compared again and again";
  EXPECT_EQ(rig.session->report().sync.distinct, 1);
  rig.swings = true;
  EXPECT_TRUE(rig.run_to(kShadow));
  EXPECT_EQ(rig.session->report().sync.distinct, 3);

  SessionSettings told = in_mode(CorrectionMode::kFull);
  told.sync.distinct = 1;
  SessionRig still(told);
  still.swings = false;
  EXPECT_TRUE(still.run_to(kActive)) << "if the configuration says so";
}

TEST(Session, AnswersEveryTargetInActiveUnderItsCounter) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  for (int i = 0; i < 1000; ++i) {
    const std::uint16_t counter = rig.counter;
    const auto answer = SessionRig::answer_in(rig.cycle());
    ASSERT_TRUE(answer.has_value());
    EXPECT_EQ(answer->counter, counter);
    EXPECT_EQ(answer->kind, MessageKind::kCorrected);
  }
  // The model's correction is there, all of it: what an independent corrector says.
  const Correction alone =
      rig.model->corrector().solve(rig.targets[rig.counter - 1], rig.q, SeedKind::kMeasured);
  const Vector3 wanted = alone.X_BC.p - rig.targets[rig.counter - 1].p;
  EXPECT_GT(wanted.norm(), 1e-4);
  EXPECT_LT((wanted - rig.last_correction).norm(), 2e-6);
}

TEST(Session, LimitedScalesAndCaps) {
  SessionSettings settings = in_mode(CorrectionMode::kLimited);
  settings.share = {.limited_scale = 0.5, .limited_m = 1.0};
  SessionRig half(settings);
  ASSERT_TRUE(half.run_to(kActive));
  half.run(1000);
  EXPECT_NEAR(half.last_correction.norm(), 0.5 * half.session->report().wanted_m, 1e-6);
  settings.share = {.limited_scale = 1.0, .limited_m = 1e-4};
  SessionRig capped(settings);
  ASSERT_TRUE(capped.run_to(kActive));
  capped.run(1000);
  EXPECT_NEAR(capped.last_correction.norm(), 1e-4, 1e-9);
}

TEST(Session, ChangesOfModeAreNoSteps) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  constexpr CorrectionMode kModes[] = {CorrectionMode::kLimited, CorrectionMode::kFull,
                                       CorrectionMode::kShadow};
  for (int i = 0; i < 60; ++i) {
    rig.session->set_mode(kModes[i % 3]);
    rig.run(37 * (i % 11));
  }
  EXPECT_GT(rig.answers, 1000);
  rig.session->set_mode(CorrectionMode::kShadow);
  EXPECT_TRUE(rig.run_to(kShadow));
}

/// Every message at the longest period that a layout may have, and every fifth of them lost.
TEST(Session, ComesAboutAndStaysAtTheSlowestPeriodsOfALayout) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  rig.pace = 0.0005;  // the step of targets that come so seldom has its limit, too
  const auto due = [](MessageKind kind, long cycle) {
    const double most_s = 0.5 * longest_silence_s(kind);
    const long every = most_s > 0.1 ? 120 : 12;  // cycles of 4 ms; actual belongs to its joints
    EXPECT_LE(0.004 * static_cast<double>(every), most_s);
    return cycle % every == 0 && cycle / every % 5 != 4;
  };
  long cycle = 0;
  const auto run = [&](long cycles) {
    for (const long end = cycle + cycles; cycle < end; ++cycle) {
      std::vector<BusMessage> said = rig.controller_says();
      std::erase_if(said, [&](const BusMessage& m) { return !due(m.kind, cycle); });
      rig.cycle(said);
    }
  };
  for (int i = 0; i < 100 && rig.session->state() != kActive; ++i) run(100);
  ASSERT_EQ(rig.session->state(), kActive);
  for (int i = 0; i < 20; ++i) {
    run(100);
    ASSERT_EQ(rig.session->state(), kActive);
  }
  EXPECT_EQ(rig.session->report().counters.holds, 0U);
}

struct OffInput {
  const char* name;
  void (*off)(ControllerState&);
  Lost lost;
};

TEST(Session, EveryInputThatGoesOffRampsOutAndBackIn) {
  SessionSettings settings = in_mode(CorrectionMode::kFull);
  settings.inputs.tool = settings.inputs.frame = settings.inputs.payload = 0;
  const OffInput inputs[] = {
      {"drives", [](ControllerState& s) { s.drives_on = false; }, Lost::kDrives},
      {"manual", [](ControllerState& s) { s.automatic = false; }, Lost::kManual},
      {"stop", [](ControllerState& s) { s.protective_stop = true; }, Lost::kStop},
      {"disabled", [](ControllerState& s) { s.correction_enabled = false; }, Lost::kDisabled},
      {"tool", [](ControllerState& s) { s.tool = 1; }, Lost::kTool},
      {"frame", [](ControllerState& s) { s.frame = 1; }, Lost::kFrame},
      {"payload", [](ControllerState& s) { s.payload = 1; }, Lost::kPayload}};
  SessionRig rig(settings);
  for (const auto& input : inputs) {
    SCOPED_TRACE(input.name);
    ASSERT_TRUE(rig.run_to(kActive));
    rig.run(600);
    EXPECT_GT(rig.last_correction.norm(), 1e-4);
    input.off(rig.state);
    rig.cycle();
    EXPECT_EQ(rig.session->state(), kHold);
    EXPECT_EQ(rig.session->report().lost, input.lost);
    EXPECT_STREQ(to_string(input.lost), input.name);
    rig.run(600);
    EXPECT_EQ(rig.session->state(), kHold);
    EXPECT_LT(rig.last_correction.norm(), 1e-9);  // answered still, with nothing
    rig.state = ready();
    rig.run(100);
    EXPECT_EQ(rig.session->state(), kHold) << "the inputs must have been good for half a second";
  }
  EXPECT_EQ(rig.session->report().counters.holds, 7U);
  EXPECT_EQ(rig.session->report().counters.faults, 0U);
}

TEST(Session, SilenceIsHeldThenComparedAnew) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  int until_hold = 0;
  for (; until_hold < 100 && rig.session->state() == kActive; ++until_hold) rig.cycle({});
  EXPECT_NEAR(until_hold * 4, 104, 8);  // ms: the limit of 100
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(SessionRig::answer_in(rig.cycle({})).has_value());
  EXPECT_EQ(rig.session->state(), kInit);
  EXPECT_TRUE(rig.run_to(kSync));
  EXPECT_TRUE(rig.run_to(kActive));
  rig.run(600);
  EXPECT_GT(rig.last_correction.norm(), 1e-4);
}

TEST(Session, LeavesSyncAndShadowWhenTheControllerFallsSilent) {
  SessionRig rig;
  ASSERT_TRUE(rig.run_to(kSync));
  for (int i = 0; i < 30; ++i) rig.cycle({});
  EXPECT_EQ(rig.session->state(), kInit);
  ASSERT_TRUE(rig.run_to(kShadow));
  for (int i = 0; i < 30; ++i) rig.cycle({});
  EXPECT_EQ(rig.session->state(), kInit);
}

/// Acknowledges: off, on for 0.2 s, off.
void acknowledge(SessionRig& rig, int cycles = 50) {
  rig.state.acknowledge = false;
  rig.run(2);
  rig.state.acknowledge = true;
  rig.run(cycles);
  rig.state.acknowledge = false;
  rig.run(1);
}

/// A session in FAULT whose cause is gone, and whose correction is out.
class AFaultToAcknowledge : public testing::Test {
 protected:
  AFaultToAcknowledge() {
    EXPECT_TRUE(rig.run_to(kActive));
    rig.robot = kRobot + 1;
    EXPECT_TRUE(rig.run_to(kFault));
    rig.robot = kRobot;
    rig.run(600);
  }
  void toggle(int on, int off, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      rig.state.acknowledge = i % (on + off) >= off;
      rig.cycle();
      ASSERT_EQ(rig.session->state(), kFault) << on << " on, " << off << " off, cycle " << i;
    }
    rig.state.acknowledge = false;
    rig.run(10);
    ASSERT_EQ(rig.session->state(), kFault) << on << " on, " << off << " off";
  }
  SessionRig rig{in_mode(CorrectionMode::kFull)};
};

TEST_F(AFaultToAcknowledge, IsNotEndedByASingleFrameNorByABitThatAProgramToggles) {
  toggle(1, 1000, 3003);
  toggle(25, 25, 5000);  // 5 Hz
  toggle(1, 1, 5000);
  toggle(49, 1, 5000);
  acknowledge(rig);
  EXPECT_EQ(rig.session->state(), kInit);
}

TEST_F(AFaultToAcknowledge, IsEndedByTheReleaseOfTheButtonAndNotBefore) {
  rig.state.acknowledge = true;
  rig.run(3000);
  EXPECT_EQ(rig.session->state(), kFault);
  rig.state.acknowledge = false;
  rig.cycle();
  EXPECT_EQ(rig.session->state(), kInit);
}

TEST_F(AFaultToAcknowledge, IsNotEndedByAPressWithAGap) {
  rig.state.acknowledge = true;
  rig.run(40);
  for (int i = 0; i < 25; ++i) rig.cycle({});  // 0.1 s without a word
  rig.run(60);
  rig.state.acknowledge = false;
  rig.run(10);
  EXPECT_EQ(rig.session->state(), kFault);

  rig.state.acknowledge = true;
  rig.run(60);
  auto messages = rig.controller_says();
  messages.front().values[1] = 0.5;  // no number of a tool: it says nothing about the button either
  rig.cycle(messages);
  rig.run(10);
  rig.state.acknowledge = false;
  rig.run(10);
  EXPECT_EQ(rig.session->state(), kFault);
  acknowledge(rig);
  EXPECT_EQ(rig.session->state(), kInit);
}

TEST(Session, APressThatBeganBeforeTheFaultAcknowledgesNothing) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  rig.state.acknowledge = true;
  rig.run(100);
  rig.robot = kRobot + 1;
  ASSERT_TRUE(rig.run_to(kFault));
  rig.robot = kRobot;
  rig.run(600);
  rig.state.acknowledge = false;
  rig.run(10);
  EXPECT_EQ(rig.session->state(), kFault);
}

/// The status that the controller hears next.
SessionStatus next_status(SessionRig& rig) {
  while (true) {
    const SessionOutput out = rig.cycle();
    for (const auto& message : out.sent())
      if (message.kind == MessageKind::kStatus) return status_in(message);
  }
}

TEST(Session, TheStatusAsksForAnAcknowledgementWhileOneHasAnEffect) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  EXPECT_FALSE(next_status(rig).asks);
  rig.robot = kRobot + 1;
  ASSERT_TRUE(rig.run_to(kFault));
  EXPECT_FALSE(next_status(rig).asks) << "the correction ramps out";
  rig.run(600);
  EXPECT_FALSE(next_status(rig).asks) << "the cause is there still";
  rig.robot = kRobot;
  rig.run(10);
  EXPECT_TRUE(next_status(rig).asks);
  EXPECT_EQ(next_status(rig).state, kFault);
  acknowledge(rig);
  EXPECT_FALSE(next_status(rig).asks);

  SessionSettings settings = in_mode(CorrectionMode::kFull);
  settings.start.acknowledgement = SessionStart::Acknowledgement::kNeeded;
  SessionRig first(settings);
  EXPECT_FALSE(next_status(first).asks) << "nothing was compared yet";
  ASSERT_TRUE(first.run_to(kShadow));
  EXPECT_TRUE(next_status(first).asks);
  acknowledge(first);
  EXPECT_FALSE(next_status(first).asks);
}

TEST(Session, AnotherPoseIsAFaultInSyncAndEverAfter) {
  SessionRig early(in_mode(CorrectionMode::kFull));
  early.pose_error = Vector3(60e-6, 0, 0);
  EXPECT_TRUE(early.run_to(kFault, 20));
  EXPECT_EQ(early.session->report().cause, FaultCause::kPoseMismatch);

  SessionRig late(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(late.run_to(kActive));
  late.run(600);
  late.pose_error = Vector3(0, 40e-6, 0);  // within 50 um
  late.run(100);
  EXPECT_EQ(late.session->state(), kActive);
  late.pose_error = Vector3(0, 60e-6, 0);
  late.run(2);
  EXPECT_EQ(late.session->state(), kActive);  // two in a row may be a slip
  late.run(2);
  EXPECT_EQ(late.session->state(), kFault);
  late.run(600);
  EXPECT_LT(late.last_correction.norm(), 1e-5);  // ramped out, then nothing is sent
  EXPECT_FALSE(SessionRig::answer_in(late.cycle()).has_value());
}

TEST(Session, AFaultWaitsForAnAcknowledgementAndForItsCauseToGo) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  rig.pose_error = Vector3(1e-3, 0, 0);
  ASSERT_TRUE(rig.run_to(kFault));
  rig.run(600);
  acknowledge(rig);
  EXPECT_EQ(rig.session->state(), kFault) << "the cause is there still";
  rig.pose_error = Vector3::Zero();
  rig.run(5000);
  EXPECT_EQ(rig.session->state(), kFault) << "never by itself";
  acknowledge(rig);
  EXPECT_NE(rig.session->state(), kFault);
  EXPECT_TRUE(rig.run_to(kActive));
}

TEST(Session, AFaultOfTheLastRunIsThereStill) {
  SessionSettings settings = in_mode(CorrectionMode::kFull);
  settings.start.fault = FaultCause::kPoseMismatch;
  SessionRig rig(settings);
  rig.run(3000);
  EXPECT_EQ(rig.session->state(), kFault);
  EXPECT_EQ(rig.session->report().cause, FaultCause::kPoseMismatch);
  EXPECT_EQ(rig.answers, 0);
  acknowledge(rig);
  EXPECT_EQ(rig.session->report().cause, FaultCause::kNone);
  EXPECT_TRUE(rig.run_to(kActive));
}

TEST(Session, TheFirstCorrectionWaitsForAnAcknowledgementWhereOneIsNeeded) {
  SessionSettings settings = in_mode(CorrectionMode::kFull);
  settings.start.acknowledgement = SessionStart::Acknowledgement::kNeeded;
  SessionRig rig(settings);
  rig.run(20);
  acknowledge(rig);
  ASSERT_TRUE(rig.run_to(kShadow));
  rig.run(3000);
  EXPECT_EQ(rig.session->state(), kShadow) << "what was pressed before the comparison is no word";
  EXPECT_EQ(rig.session->report().lost, Lost::kAcknowledge);
  EXPECT_EQ(rig.answers, 0);
  acknowledge(rig);
  EXPECT_TRUE(rig.run_to(kActive, 130)) << "half a second after it";
  rig.state.automatic = false;
  rig.run(500);
  rig.state.automatic = true;
  EXPECT_TRUE(rig.run_to(kActive)) << "once is enough";
}

TEST(Session, AnAcknowledgementThatHangsIsNone) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  rig.state.acknowledge = true;
  ASSERT_TRUE(rig.run_to(kActive));
  rig.robot = kRobot + 1;
  ASSERT_TRUE(rig.run_to(kFault));
  EXPECT_EQ(rig.session->report().cause, FaultCause::kOtherRobot);
  rig.robot = kRobot;
  rig.run(1000);
  EXPECT_EQ(rig.session->state(), kFault);
  for (int i = 0; i < 100; ++i) rig.cycle({});  // the controller falls silent, and comes back
  rig.run(100);
  EXPECT_EQ(rig.session->state(), kFault);
  acknowledge(rig);
  EXPECT_NE(rig.session->state(), kFault);
}

TEST(Session, ASecondSenderIsAFaultForAsLongAsItSends) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  rig.tick.foreign_senders = 1;
  rig.cycle();
  EXPECT_EQ(rig.session->state(), kFault);
  EXPECT_EQ(rig.session->report().cause, FaultCause::kForeignSender);
  for (int i = 0; i < 600; ++i) {
    ++rig.tick.foreign_senders;
    rig.cycle();
  }
  acknowledge(rig);
  EXPECT_EQ(rig.session->state(), kFault);
  rig.run(300);
  acknowledge(rig);
  EXPECT_NE(rig.session->state(), kFault);
}

TEST(Session, AControllerThatWasRestartedIsCorrectedAnew) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  rig.tick.peer = SessionTick::Peer::kRestarted;
  rig.cycle();
  rig.tick.peer = SessionTick::Peer::kSame;
  EXPECT_EQ(rig.session->state(), kHold);
  EXPECT_EQ(rig.session->report().lost, Lost::kRestart);
  rig.run(120);
  EXPECT_EQ(rig.session->state(), kHold) << "for half a second";
  EXPECT_TRUE(rig.run_to(kActive, 10));
  EXPECT_EQ(rig.session->report().counters.faults, 0U);
}

TEST(Session, StopsByRampingOut) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  EXPECT_FALSE(rig.session->at_rest());
  rig.tick.run = SessionTick::Run::kStop;
  int cycles = 0;
  while (!rig.session->at_rest() && cycles < 1000) {
    rig.cycle();
    ++cycles;
  }
  EXPECT_LT(rig.last_correction.norm(), 1e-5);
  EXPECT_NEAR(cycles, 250, 15);  // the model's ramp of a second
  rig.run(500);
  EXPECT_TRUE(rig.session->at_rest());
  EXPECT_EQ(rig.session->state(), kShadow);
}

TEST(Session, ASwapOfTheModelIsNoStep) {
  SessionRig rig(in_mode(CorrectionMode::kFull));
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  const Vector3 before = rig.last_correction;
  format::Model other = one_arm();
  for (auto& joint : other.calibrated.joints) joint.a -= 3e-4;
  const auto next = loaded(other);
  ASSERT_EQ(rig.slot.publish(*next), ModelSlot::Published::kDone);
  rig.run(1000);
  EXPECT_EQ(rig.session->report().guard.swaps, 1U);
  EXPECT_GT((rig.last_correction - before).norm(), 1e-4);
}

TEST(Session, OffsetsAreTheSameCorrection) {
  SessionSettings settings = in_mode(CorrectionMode::kFull);
  settings.form = CorrectionForm::kOffset;
  SessionRig rig(settings);
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  EXPECT_GT(rig.last_correction.norm(), 1e-4);
  EXPECT_NEAR(rig.last_correction.norm(), rig.session->report().applied_m, 1e-9);
}

}  // namespace
}  // namespace plumb::tests
