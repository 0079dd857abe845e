// SPDX-License-Identifier: Apache-2.0
// What a bad bus, a stopped process and a wild planner do to a session: never a step, never an
// answer to an old target. SessionRig checks the first at every cycle.
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <limits>

#include "tests/drivers/session_rig.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::tests {
namespace {

using enum SessionState;

SessionSettings full() {
  SessionSettings out;
  out.mode = CorrectionMode::kFull;
  return out;
}

TEST(SessionFaults, ThirtyPercentLossCostsAnswersAndNothingElse) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  Random random(1);
  const long before = rig.answers;
  for (int i = 0; i < 5000; ++i) {
    auto messages = rig.controller_says();
    std::erase_if(messages, [&](const BusMessage&) { return random.below(10) < 3; });
    rig.cycle(messages);
  }
  EXPECT_EQ(rig.session->state(), kActive);
  EXPECT_NEAR(static_cast<double>(rig.answers - before), 3500.0, 150.0);
  EXPECT_GT(rig.last_correction.norm(), 1e-4);
}

TEST(SessionFaults, TwentyMillisecondsInAQueueOfOursAreTooOldToAnswer) {
  SessionSettings settings = full();
  settings.answer_s = 0.015;
  SessionRig rig(settings);
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  std::deque<std::vector<BusMessage>> queue;
  const long before = rig.answers;
  for (int i = 0; i < 400; ++i) {
    queue.push_back(rig.controller_says());  // with the time of their reception
    if (queue.size() > 5) {
      rig.cycle(queue.front());
      queue.pop_front();
    } else {
      rig.cycle({});
    }
  }
  EXPECT_EQ(rig.answers, before);
  EXPECT_GT(rig.session->report().counters.too_old, 300U);
}

TEST(SessionFaults, DelayOnTheWayIsAnsweredUnderTheOldCounter) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  std::deque<std::vector<BusMessage>> way;
  const long before = rig.answers;
  for (int i = 0; i < 1000; ++i) {
    way.push_back(rig.controller_says());
    if (way.size() <= 5) {
      rig.cycle({});
      continue;
    }
    for (auto& message : way.front()) message.time_ns = rig.now_ns;
    rig.cycle(way.front());
    way.pop_front();
  }
  EXPECT_EQ(rig.session->state(), kActive);
  EXPECT_EQ(rig.answers - before, 995);
}

TEST(SessionFaults, RepeatsAndOvertakenTargetsAreNotAnswered) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  const BusMessage old = rig.controller_says().back();
  rig.cycle();
  for (int i = 0; i < 8; ++i) {
    BusMessage late = old;
    late.time_ns = rig.now_ns;
    EXPECT_FALSE(SessionRig::answer_in(rig.cycle(std::span(&late, 1))).has_value());
    rig.cycle();
  }
  EXPECT_EQ(rig.session->report().counters.out_of_order, 7U);
  EXPECT_EQ(rig.session->report().counters.repeated, 1U);
}

TEST(SessionFaults, OfABurstOnlyTheNewestTargetIsAnswered) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  for (int round = 0; round < 100; ++round) {
    std::vector<BusMessage> burst;
    for (int i = 0; i < 3; ++i) {
      for (auto& message : rig.controller_says()) burst.push_back(message);
      rig.cycle({});
    }
    for (auto& message : burst) message.time_ns = rig.now_ns;
    const auto answer = SessionRig::answer_in(rig.cycle(burst));
    ASSERT_TRUE(answer.has_value());
    EXPECT_EQ(answer->counter, burst.back().counter);
  }
  EXPECT_EQ(rig.session->state(), kActive);
  EXPECT_EQ(rig.session->report().counters.too_fast, 0U);
}

TEST(SessionFaults, ASecondStoppedAnswersNothingOldAndRampsBackIn) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  std::vector<BusMessage> queued;  // what the kernel kept meanwhile
  for (int i = 0; i < 250; ++i) {
    for (auto& message : rig.controller_says()) queued.push_back(message);
    rig.now_ns += kCycle_ns;
    ++rig.counter;
    rig.swing();
  }
  const std::uint16_t newest = queued.back().counter;
  const auto answer = SessionRig::answer_in(rig.cycle(queued));
  if (answer) {
    EXPECT_EQ(answer->counter, newest);
  }
  EXPECT_TRUE(rig.run_to(kActive));
  rig.run(600);
  EXPECT_GT(rig.last_correction.norm(), 1e-4);
}

TEST(SessionFaults, AStallLeavesTheCorrectionWhereTheRampWouldHaveTakenIt) {
  for (const double stall_s : {0.15, 0.6, 2.0}) {
    SCOPED_TRACE(stall_s);
    SessionRig rig(full());
    ASSERT_TRUE(rig.run_to(kActive));
    rig.run(600);
    const double before_m = rig.last_correction.norm();
    ASSERT_GT(before_m, 3e-4);
    rig.now_ns += static_cast<std::int64_t>(1e9 * stall_s);
    rig.cycle();  // with fresh messages: it is plumb-rt alone that was away
    EXPECT_EQ(rig.session->state(), kHold);
    EXPECT_EQ(rig.session->report().counters.stalls, 1U);
    EXPECT_TRUE(has(rig.session->report().lost, Lost::kStall));
    const double left = std::max(0.0, 1.0 - (stall_s - 0.1));  // of the ramp of a second
    EXPECT_LE(rig.last_correction.norm(), left * before_m);
    EXPECT_GE(rig.last_correction.norm(), 0.7 * left * before_m) << "and no step to zero";
    double most_m = rig.last_correction.norm();
    for (int i = 0; i < 120; ++i) {
      rig.cycle();
      EXPECT_LE(rig.last_correction.norm(), most_m + 1e-9) << "it only goes down in HOLD";
      most_m = rig.last_correction.norm();
    }
    EXPECT_EQ(rig.session->state(), kHold) << "for half a second";
    ASSERT_TRUE(rig.run_to(kActive, 10));
    EXPECT_FALSE(has(rig.session->report().lost, Lost::kStall));
    rig.run(600);
    EXPECT_GT(rig.last_correction.norm(), 3e-4);
  }
}

TEST(SessionFaults, AMachineThatWasSuspendedIsAStallThoughItsClockStoodStill) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  rig.tick.host = SessionTick::Host::kSlept;
  rig.now_ns += 200'000'000;  // for the rig: a correction may have gone in that time
  rig.cycle();
  rig.tick.host = SessionTick::Host::kAwake;
  EXPECT_EQ(rig.session->state(), kHold);
  EXPECT_LT(rig.last_correction.norm(), 1e-9);
  EXPECT_TRUE(rig.run_to(kActive));
}

/// A session at work in which the controller's messages are changed from then on.
void changed(SessionRig& rig, int cycles,
             const std::function<void(std::vector<BusMessage>&)>& change) {
  for (int i = 0; i < cycles; ++i) {
    auto messages = rig.controller_says();
    change(messages);
    rig.cycle(messages);
  }
}

TEST(SessionFaults, WithoutAPoseComparedForASecondItHolds) {
  const std::function<void(std::vector<BusMessage>&)> causes[] = {
      [](auto& messages) {
        std::erase_if(messages, [](auto& m) { return m.kind == MessageKind::kActual; });
      },
      [](auto& messages) {  // counters that do not pair; and the pose is 200 mm off
        for (auto& m : messages)
          if (m.kind == MessageKind::kActual) {
            m.counter = static_cast<std::uint16_t>(m.counter + 1000);
            m.values[2] += 0.2;
          }
      },
      [](auto& messages) {
        for (auto& m : messages)
          if (m.kind == MessageKind::kActual) m.values[4] = std::nan("");
      }};
  for (const auto& cause : causes) {
    SessionRig rig(full());
    ASSERT_TRUE(rig.run_to(kActive));
    rig.run(600);
    changed(rig, 60, cause);
    EXPECT_EQ(rig.session->state(), kActive) << "a quarter of a second is not too long";
    changed(rig, 200, cause);
    EXPECT_NE(rig.session->state(), kActive);
    EXPECT_TRUE(has(rig.session->report().lost, Lost::kComparison));
    changed(rig, 300, cause);
    EXPECT_LT(rig.session->report().applied_m, 1e-9);
    EXPECT_TRUE(rig.run_to(kActive)) << "and it comes back by itself";
  }
}

TEST(SessionFaults, WithoutTheRobotsIdentityForASecondItHolds) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  changed(rig, 260, [](auto& messages) {
    std::erase_if(messages, [](auto& m) { return m.kind == MessageKind::kRobot; });
  });
  EXPECT_EQ(rig.session->state(), kHold);
  EXPECT_EQ(rig.session->report().lost, Lost::kRobot);
}

TEST(SessionFaults, JointsThatAreNoNumbersAreLostAndSaidToBe) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  changed(rig, 30, [](auto& messages) {
    for (auto& m : messages)
      if (m.kind == MessageKind::kJoints) m.values[3] = std::nan("");
  });
  EXPECT_EQ(rig.session->state(), kHold);
  EXPECT_TRUE(has(rig.session->report().lost, Lost::kJoints));
  EXPECT_EQ(rig.session->report().counters.no_joints, 30U);
}

TEST(SessionFaults, TargetsInAnotherFrameHold) {
  for (const double away_m : {0.03, 0.04}) {  // less than a step may be
    SessionRig rig(full());
    ASSERT_TRUE(rig.run_to(kActive));
    rig.jump = Vector3(0, 0, 0.006);
    rig.run(300);
    EXPECT_EQ(rig.session->state(), kActive) << "within the limit";
    for (double moved_m = 0.006; moved_m < away_m; moved_m += 1e-3) {
      rig.jump = Vector3(0, 0, moved_m);
      rig.run(1);
    }
    EXPECT_TRUE(rig.run_to(kHold, 1600)) << "at the turn of its swing at the latest";
    rig.swings = false;
    rig.run(500);
    EXPECT_EQ(rig.session->state(), kHold);
    EXPECT_TRUE(has(rig.session->report().lost, Lost::kArmAway));
    EXPECT_LT(rig.session->report().applied_m, 1e-9);
    rig.jump = Vector3::Zero();
    EXPECT_TRUE(rig.run_to(kActive));
  }
}

TEST(SessionFaults, AnArmInAnotherFrameFromTheBeginningIsNeverCorrected) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kShadow));
  rig.swings = false;
  rig.jump = Vector3(0.03, 0, 0);
  EXPECT_FALSE(rig.run_to(kActive));
  EXPECT_TRUE(has(rig.session->report().lost, Lost::kArmAway));
}

/// The controller repeats its joints and its pose under new counters while the targets go on.
TEST(SessionFaults, AnArmThatStandsStillUnderMovingTargetsHolds) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  const auto frozen = rig.controller_says();
  int cycles = 0;
  for (; cycles < 500 && rig.session->state() == kActive; ++cycles) {
    auto messages = rig.controller_says();
    for (auto& m : messages)
      for (const auto& old : frozen)
        if (old.kind == m.kind && m.kind != MessageKind::kTarget) m.values = old.values;
    rig.phase -= 0.0018;  // so slowly that the targets stay within the limit of distance
    rig.cycle(messages);
  }
  EXPECT_EQ(rig.session->state(), kHold);
  EXPECT_EQ(rig.session->report().lost, Lost::kArmStill);
  EXPECT_LT(0.004 * cycles, 1.0);
}

TEST(SessionFaults, AnArmAtRestUnderATargetAtRestIsCorrectedForAsLongAsItStands) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.swings = false;
  rig.run(3000);
  EXPECT_EQ(rig.session->state(), kActive);
  EXPECT_EQ(rig.session->report().counters.holds, 0U);
}

/// Whatever the delay of the controller: the arm is where a target of the last 0.3 s was.
TEST(SessionFaults, AnArmThatFollowsItsTargetsLateIsNotAway) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  std::deque<std::vector<BusMessage>> said;
  for (int i = 0; i < 2000; ++i) {
    rig.phase += 0.004;  // half a metre a second and more
    auto messages = rig.controller_says();
    said.push_back(messages);
    for (std::size_t k = 0; k < messages.size(); ++k)
      if (messages[k].kind == MessageKind::kJoints || messages[k].kind == MessageKind::kActual)
        messages[k].values = said.front()[k].values;
    if (said.size() > 62) said.pop_front();  // a quarter of a second
    rig.cycle(messages);
    ASSERT_EQ(rig.session->state(), kActive) << i;
  }
}

TEST(SessionFaults, ClockJumpsAreNoSteps) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  for (const std::int64_t jump_s : {3600, -3600, 1, -1, -3600 * 24}) {
    rig.now_ns += jump_s * 1'000'000'000;
    rig.run(600);
    EXPECT_TRUE(rig.run_to(kActive));
  }
  rig.now_ns -= 1'000'000'000;
  const std::int64_t stands = rig.now_ns;
  int cycles = 0;
  for (; cycles < 100 && rig.session->state() == kActive; ++cycles) {
    rig.now_ns = stands;  // a clock that stands does not hide that nothing comes
    rig.cycle({});
  }
  EXPECT_LT(cycles, 30);
}

TEST(SessionFaults, ATargetThatJumpsIsNotAnsweredAndHolds) {
  SessionSettings settings = full();
  settings.arm.distance_m = 0.2;  // the arm of this rig does not follow
  SessionRig rig(settings);
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  rig.jump = Vector3(0.06, 0, 0);
  EXPECT_FALSE(SessionRig::answer_in(rig.cycle()).has_value());
  EXPECT_EQ(rig.session->state(), kHold);
  EXPECT_EQ(rig.session->report().lost, Lost::kMotion);
  EXPECT_EQ(rig.session->report().counters.too_far, 1U);
  EXPECT_TRUE(SessionRig::answer_in(rig.cycle()).has_value()) << "it stays there: ramping out";
  EXPECT_TRUE(rig.run_to(kActive));
  rig.jump = Vector3(0.06 + 0.02, 0, 0);  // 20 mm in 4 ms: 5 m/s
  EXPECT_FALSE(SessionRig::answer_in(rig.cycle()).has_value());
  EXPECT_EQ(rig.session->report().counters.too_fast, 1U);
  EXPECT_TRUE(rig.run_to(kActive));
}

/// A session at work, whose controller then asks in one cycle of `every` only, until it is quiet.
void expect_end_without_correction(int every, const std::function<void(SessionRig&)>& cause) {
  SCOPED_TRACE(every);
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  ASSERT_GT(rig.last_correction.norm(), 1e-4);
  const auto run = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      cause(rig);
      auto messages = rig.controller_says();
      if (i % every != 0) messages.pop_back();  // the target
      rig.cycle(messages);
    }
  };
  run(500);
  EXPECT_LE(rig.last_correction.norm(), 1e-9) << "less than a count of any layout";
  EXPECT_TRUE(rig.session->at_rest());
  const long before = rig.answers;
  run(100);
  EXPECT_EQ(rig.answers, before);
}

TEST(SessionFaults, TheLastAnswerHasNoCorrectionHoweverSeldomTargetsCome) {
  for (const int every : {1, 2, 5, 7}) {
    expect_end_without_correction(every, [](SessionRig& rig) { ++rig.tick.foreign_senders; });
    expect_end_without_correction(every,
                                  [](SessionRig& rig) { rig.tick.run = SessionTick::Run::kStop; });
    expect_end_without_correction(
        every, [](SessionRig& rig) { rig.session->set_mode(CorrectionMode::kShadow); });
  }
}

TEST(SessionFaults, AControllerThatAsksNoMoreDoesNotKeepASessionFromItsRest) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  rig.tick.run = SessionTick::Run::kStop;
  for (int i = 0; i < 500; ++i) {
    auto messages = rig.controller_says();
    messages.pop_back();
    rig.cycle(messages);
  }
  EXPECT_TRUE(rig.session->at_rest());
}

TEST(SessionFaults, NumbersThatAreNoneAreNotAnswered) {
  SessionRig rig(full());
  ASSERT_TRUE(rig.run_to(kActive));
  rig.run(600);
  const double kBad[] = {std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(), -1e308};
  for (const double bad : kBad)
    for (std::size_t value = 0; value < 6; ++value) {
      auto messages = rig.controller_says();
      messages.back().values[value] = bad;
      EXPECT_FALSE(SessionRig::answer_in(rig.cycle(messages)).has_value());
    }
  for (const double bad : kBad)  // and everywhere at once
    for (int i = 0; i < 100; ++i) {
      auto messages = rig.controller_says();
      for (auto& message : messages) message.values.fill(bad);
      EXPECT_FALSE(SessionRig::answer_in(rig.cycle(messages)).has_value());
    }
}

TEST(SessionFaults, RandomMessagesNeverMakeAStep) {
  const int count = static_cast<int>(scaled(20'000));
  Random random(7);
  const auto rarely = [&] { return random.below(50) == 0; };
  SessionSettings settings = full();
  settings.sync.distinct = 1;
  SessionRig rig(settings);
  for (int i = 0; i < count; ++i) {
    auto messages = rig.controller_says();
    if (rarely()) {
      BusMessage wild;
      wild.kind = static_cast<MessageKind>(random.below(static_cast<int>(kMessageKinds)));
      wild.size = kMaxMessageValues;
      wild.counter = static_cast<std::uint16_t>(random.bits());
      wild.time_ns = rig.now_ns;
      for (double& x : wild.values) x = random.uniform(-10.0, 10.0);
      messages.push_back(wild);
      if (wild.kind == MessageKind::kTarget) rig.targets[wild.counter] = pose_in(wild).value();
    }
    if (random.below(1000) == 0) rig.now_ns += random.below(2'000'000'000);
    if (random.below(60) == 0) rig.state.acknowledge = !rig.state.acknowledge;
    rig.cycle(messages);
  }
  std::printf("%d cycles, seed 7, %ld answers, %llu faults, %llu holds\n", count, rig.answers,
              static_cast<unsigned long long>(rig.session->report().counters.faults),
              static_cast<unsigned long long>(rig.session->report().counters.holds));
  EXPECT_GT(rig.answers, 100);
  EXPECT_GT(rig.session->report().counters.holds, 5U);
}

}  // namespace
}  // namespace plumb::tests
