// SPDX-License-Identifier: Apache-2.0
// The cycle's thread on a bus in memory, in scripted time; every heap call of this program is
// counted.
#include "plumb/drivers/run_loop.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "plumb/drivers/can_port.hpp"
#include "tests/drivers/in_memory_port.hpp"
#include "tests/drivers/scripted_time.hpp"
#include "tests/drivers/session_rig.hpp"
#include "tests/drivers/socket_pair.hpp"
#include "tests/heap_calls.hpp"

namespace plumb::tests {
namespace {

using namespace drivers;
using Loop = RunLoop<ScriptedTime>;

/// A run whose controller is SessionRig's, put on the bus before each tick.
struct Bench {
  explicit Bench(CorrectionMode mode, RunSettings how = {})
      : rig(settings(mode)), shared(std::make_unique<RunShared>()) {
    script.now_ns = rig.now_ns;
    clock = std::make_unique<CycleClock<ScriptedTime>>(kCycle_ns, ScriptedTime{&script});
    loop = std::make_unique<Loop>(*rig.session, port, *shared, *clock, ScriptedTime{&script}, how);
  }
  static SessionSettings settings(CorrectionMode mode) {
    SessionSettings out;
    out.mode = mode;
    return out;
  }

  Loop::Next cycle() {
    rig.now_ns = script.now_ns + kCycle_ns;
    for (auto& message : rig.controller_says()) {
      if (message.kind == MessageKind::kTarget) message.time_ns -= target_waited_ns;
      port.coming.push_back(message);
    }
    ++rig.counter;
    rig.swing();
    return loop->cycle();
  }
  /// As candump's reader would: so the ring does not fill.
  void empty_ring() {
    for (RecordEntry entry; shared->record.take(entry);) {
    }
  }

  SessionRig rig;
  std::int64_t target_waited_ns = 0;
  InMemoryPort port;
  Script script;
  std::unique_ptr<RunShared> shared;
  std::unique_ptr<CycleClock<ScriptedTime>> clock;
  std::unique_ptr<Loop> loop;
};

TEST(RunLoop, AnswersOnTheBusWhatTheSessionSays) {
  Bench run(CorrectionMode::kFull);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(run.cycle(), Loop::Next::kGoOn);
  EXPECT_EQ(run.rig.session->state(), SessionState::kActive);
  long answers = 0;
  for (const auto& message : run.port.sent)
    answers += message.kind == MessageKind::kCorrected ? 1 : 0;
  EXPECT_EQ(static_cast<std::uint64_t>(answers), run.rig.session->report().counters.answered);
  EXPECT_GT(answers, 500);
}

TEST(RunLoop, StopsOnlyWhenTheCorrectionIsOut) {
  Bench run(CorrectionMode::kFull);
  for (int i = 0; i < 1000; ++i) run.cycle();
  run.shared->stop = true;
  int cycles = 0;
  while (run.cycle() == Loop::Next::kGoOn && cycles < 1000) ++cycles;
  EXPECT_NEAR(cycles, 250, 20);
  EXPECT_TRUE(run.rig.session->at_rest());
}

/// Targets that wait too long in our own queue are asked for, and never answered.
TEST(RunLoop, StopsInTheStatedTimeThoughTheCorrectionCannotBeTakenAway) {
  Bench run(CorrectionMode::kFull);
  for (int i = 0; i < 1000; ++i) run.cycle();
  ASSERT_EQ(run.rig.session->state(), SessionState::kActive);
  run.shared->stop = true;
  run.target_waited_ns = 50'000'000;
  int cycles = 0;
  while (run.cycle() == Loop::Next::kGoOn && cycles < 5000) ++cycles;
  EXPECT_FALSE(run.rig.session->at_rest());
  EXPECT_NEAR(0.004 * cycles, run.rig.session->ramp_out_s() + 1.0, 0.02);
}

TEST(RunLoop, GivesUpADeadBusOnlyWhenTold) {
  Bench patient(CorrectionMode::kFull);
  patient.port.link = LinkState::kDown;
  for (int i = 0; i < 2000; ++i) ASSERT_EQ(patient.cycle(), Loop::Next::kGoOn);
  Bench told(CorrectionMode::kFull, {.give_up_ns = 1'000'000'000});
  told.port.link = LinkState::kDown;
  int cycles = 0;
  while (told.cycle() == Loop::Next::kGoOn && cycles < 2000) ++cycles;
  EXPECT_NEAR(cycles, 250, 1);
}

TEST(RunLoop, ASecondStoppedIsOneTickAndNoStep) {
  Bench run(CorrectionMode::kFull);
  for (int i = 0; i < 1000; ++i) run.cycle();
  run.script.now_ns += 1'000'000'000;
  for (int i = 0; i < 1000; ++i) run.cycle();
  EXPECT_GE(run.clock->counters().missed, 249U);
  EXPECT_EQ(run.rig.session->report().counters.stalls, 1U);
  EXPECT_EQ(run.rig.session->state(), SessionState::kActive);
}

TEST(RunLoop, TellsTheSessionOnceThatTheControllerWasRestarted) {
  Bench run(CorrectionMode::kFull);
  for (int i = 0; i < 1000; ++i) run.cycle();
  ++run.port.counted.restarts;
  run.cycle();
  EXPECT_EQ(run.rig.session->state(), SessionState::kHold);
  EXPECT_EQ(run.rig.session->report().lost, Lost::kRestart);
  for (int i = 0; i < 200; ++i) run.cycle();
  EXPECT_EQ(run.rig.session->state(), SessionState::kActive);
  EXPECT_EQ(run.rig.session->report().counters.holds, 1U);
}

TEST(RunLoop, AFullRecordCostsTheCycleNothing) {
  Bench run(CorrectionMode::kFull);
  for (int i = 0; i < 5000; ++i) run.cycle();  // nobody empties the ring
  EXPECT_GT(run.shared->record.lost(), 0U);
  EXPECT_EQ(run.rig.session->state(), SessionState::kActive);
}

TEST(RunLoop, ASnapshotIsOfTheWholeRun) {
  Bench run(CorrectionMode::kShadow);
  for (int i = 0; i < 100; ++i) run.cycle();
  RunSnapshot snapshot;
  ASSERT_TRUE(run.shared->snapshots.take(snapshot));
  EXPECT_EQ(snapshot.session.state, SessionState::kSync);
  EXPECT_GT(snapshot.session.sync.compared, 80U);
  EXPECT_GT(snapshot.wake.count(), 80U);
  EXPECT_FALSE(run.shared->snapshots.take(snapshot));
}

/// A run on a CAN link, whose other end the controller and an intruder share.
struct CanBench {
  CanBench()
      : rig(Bench::settings(CorrectionMode::kFull)),
        intruder(::dup(sockets.other_end())),
        plumb(CanLink(sockets.link_end(), can_link_options(layout)), layout, Sender::kPlumb),
        controller(CanLink(sockets.release(), can_link_options(layout)), layout,
                   Sender::kController) {
    script.now_ns = rig.now_ns;
  }
  ~CanBench() { ::close(intruder); }

  void cycle() {
    for (const auto& message : rig.controller_says()) controller.send(message);
    for (BusMessage answer; controller.receive(answer);) {
    }
    loop.cycle();
    ++rig.counter;
    rig.swing();
    for (RecordEntry entry; shared->record.take(entry);) {
    }
  }
  bool run_to(SessionState state) {
    for (int i = 0; i < 2000 && rig.session->state() != state; ++i) cycle();
    return rig.session->state() == state;
  }
  /// A push of the button. The times of frames are those of this machine's clock.
  void press() {
    rig.state.acknowledge = true;
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(250);
    while (std::chrono::steady_clock::now() < end) {
      cycle();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    rig.state.acknowledge = false;
    cycle();
  }
  void intrude(const can_frame& frame) const {
    ASSERT_EQ(::send(intruder, &frame, sizeof(frame), 0), static_cast<ssize_t>(sizeof(frame)));
  }

  SessionRig rig;
  BusLayout layout = default_layout(6, 0.004);
  SocketPair sockets;
  int intruder;
  CanPort plumb, controller;
  Script script;
  std::unique_ptr<RunShared> shared = std::make_unique<RunShared>();
  CycleClock<ScriptedTime> clock{kCycle_ns, ScriptedTime{&script}};
  Loop loop{*rig.session, plumb, *shared, clock, ScriptedTime{&script}, {}};
};

TEST(RunLoop, AFrameOfOurOwnIdentifierIsAFaultThatRampsOutAndWaitsForAnOperator) {
  CanBench run;
  ASSERT_TRUE(run.run_to(SessionState::kActive));
  for (int i = 0; i < 500; ++i) run.cycle();
  const auto applied_m = [&] { return run.rig.session->report().applied_m; };
  ASSERT_GT(applied_m(), 2e-4);
  run.intrude(classic(0x700, {1, 2, 3}));
  run.cycle();
  ASSERT_EQ(run.rig.session->state(), SessionState::kActive) << "it is none of ours";
  run.intrude(classic(run.layout.find(MessageKind::kCorrected)->can_id, {}));
  run.cycle();
  ASSERT_EQ(run.rig.session->state(), SessionState::kFault);
  EXPECT_EQ(run.rig.session->report().cause, FaultCause::kForeignSender);
  EXPECT_GT(applied_m(), 1e-4) << "it ramps out, and does not step";
  for (int i = 0; i < 1000; ++i) run.cycle();
  EXPECT_EQ(applied_m(), 0.0);
  EXPECT_EQ(run.rig.session->state(), SessionState::kFault) << "nobody acknowledged";
  for (int i = 0; i < 20 && run.rig.session->state() == SessionState::kFault; ++i) run.press();
  EXPECT_TRUE(run.run_to(SessionState::kActive));
}

TEST(RunLoop, NeverAllocates) {
  Bench run(CorrectionMode::kFull);
  for (int i = 0; i < 100; ++i) run.cycle();
  long counted = 0;
  for (int i = 0; i < 100'000; ++i) {
    run.rig.now_ns = run.script.now_ns + kCycle_ns;
    for (const auto& message : run.rig.controller_says()) run.port.coming.push_back(message);
    ++run.rig.counter;
    run.rig.swing();
    const long before = heap_calls;
    run.loop->cycle();
    counted += heap_calls - before;
    run.port.sent.clear();
    if (i % 100 == 0) run.empty_ring();
  }
  EXPECT_EQ(counted, 0);
  EXPECT_EQ(run.rig.session->state(), SessionState::kActive);
  const long before = heap_calls;
  const auto planted = std::make_unique<double>(1.0);
  EXPECT_EQ(*planted, 1.0);
  EXPECT_EQ(heap_calls - before, 1) << "the guard is asleep";
}

}  // namespace
}  // namespace plumb::tests
