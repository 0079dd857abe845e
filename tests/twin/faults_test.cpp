// SPDX-License-Identifier: Apache-2.0
// What goes wrong between a controller and plumb-rt must not move the arm wrongly: no step in the
// correction, no correction that is old, and back to it afterwards. Virtual time, frames of CAN FD.
#include <gtest/gtest.h>

#include "tests/twin/calibrated_twin.hpp"
#include "tests/twin/loop.hpp"

namespace plumb::offline::twin {
namespace {

using drivers::SessionState;

constexpr double kSlack = 1.0001;

FaultPlan plan(const std::vector<std::string>& faults) {
  std::vector<Fault> out;
  for (const auto& text : faults) out.push_back(parse_fault(text));
  return FaultPlan(std::move(out));
}

/// A loop over 40 stations with what is wrong in it.
class Case {
 public:
  explicit Case(const std::vector<std::string>& faults, const OurSide& side = {})
      : faults_(plan(faults)),
        path_(generated_path(twin().cell(), 40, 0.5, 7)),
        loop_(twin().cell(), twin().model(), path_, faults_, layout(), side, settings()) {}

  static const CalibratedTwin& twin() { return CalibratedTwin::usual(); }
  static ControllerSettings settings() {
    ControllerSettings out;
    out.wait_s = 10.0;
    return out;
  }
  static drivers::BusLayout layout() {
    auto out = drivers::default_layout(twin().cell().joints(), twin().cell().deploy.cycle_s);
    out.can_format = drivers::CanFrame::Format::kFd;
    return out;
  }

  Loop& loop() { return loop_; }
  Controller& controller() { return loop_.controller(); }
  bool run() { return loop_.run(600.0); }
  void expect_no_step() {
    EXPECT_LE(controller().counters().largest_step_m,
              settings().receiver.slew_m_per_s * settings().cycle_s * kSlack);
  }

 private:
  FaultPlan faults_;
  Path path_;
  Loop loop_;
};

TEST(Faults, LossDelayRepetitionReorderingAndCorruptionDoNotStepNorStopTheCorrection) {
  for (const char* fault : {"lose=30%", "late=20ms", "repeat=30%", "reorder=20%", "corrupt=5%"}) {
    SCOPED_TRACE(fault);
    Case now({fault});
    ASSERT_TRUE(now.run());
    now.expect_no_step();
    EXPECT_GT(now.controller().counters().largest_offset_m, 0.5e-3);
    EXPECT_EQ(now.controller().receiver().counters().too_large, 0U);
    EXPECT_EQ(now.loop().session().state(), SessionState::kActive);
  }
}

TEST(Faults, EveryCorruptFrameIsSeen) {
  Case now({"corrupt=5%"});
  ASSERT_TRUE(now.run());
  EXPECT_GT(now.loop().heard().corrupt, 100U);
}

TEST(Faults, TheSameSeedGivesTheSameCase) {
  const auto after = [](const std::vector<std::string>& faults) {
    Case now(faults);
    EXPECT_TRUE(now.run());
    return std::pair{now.controller().counters().cycles,
                     now.controller().receiver().counters().used};
  };
  EXPECT_EQ(after({"lose=30%", "reorder=10%"}), after({"lose=30%", "reorder=10%"}));
}

/// The correction while something is wrong from 3 s to 6 s of the path, and after it.
struct Course {
  double least_m = INFINITY;
  bool came_back = false;
};

Course course_of(Case& now) {
  Course out;
  double path_begin_s = -1.0;
  while (!now.controller().done() && now.loop().now_s() < 300.0) {
    now.loop().cycle();
    if (path_begin_s < 0.0 && !now.controller().stops().empty()) path_begin_s = now.loop().now_s();
    const double since_s = path_begin_s < 0.0 ? 0.0 : now.loop().now_s() - path_begin_s;
    const double size_m = now.controller().receiver().present().translation.norm();
    if (since_s > 3.0 && since_s < 6.5) out.least_m = std::min(out.least_m, size_m);
    if (since_s > 6.5 && size_m > 0.5e-3) out.came_back = true;
  }
  return out;
}

TEST(Faults, ALostLineRampsTheCorrectionOutAndItComesBack) {
  for (const char* fault : {"disconnect@3+3", "reboot@3+3"}) {
    SCOPED_TRACE(fault);
    Case now({fault});
    const Course course = course_of(now);
    now.expect_no_step();
    EXPECT_TRUE(course.came_back);
    if (std::string(fault).starts_with("disconnect")) {
      EXPECT_LT(course.least_m, 1e-6);
    }
  }
}

TEST(Faults, WhatForbidsCorrectionsRampsThemOutAndTheyComeBack) {
  for (const char* fault : {"manual@3+3", "disable@3+3"}) {
    SCOPED_TRACE(fault);
    Case now({fault});
    const Course course = course_of(now);
    now.expect_no_step();
    EXPECT_LT(course.least_m, 1e-6);
    EXPECT_TRUE(course.came_back);
  }
}

TEST(Faults, WhilePlumbRtIsDeadTheReceiverRampsOutByItself) {
  Case now({}, {.dies_s = 8.0, .back_s = 11.0});
  double least_m = INFINITY;
  while (!now.controller().done() && now.loop().now_s() < 300.0) {
    now.loop().cycle();
    if (now.loop().now_s() > 8.0 && now.loop().now_s() < 11.0)
      least_m = std::min(least_m, now.controller().receiver().present().translation.norm());
  }
  EXPECT_TRUE(now.controller().done());
  now.expect_no_step();
  EXPECT_EQ(least_m, 0.0);
  EXPECT_GT(now.controller().receiver().present().translation.norm(), 0.5e-3);
}

TEST(Faults, AControllerThatCorrectsItselfIsNotCorrectedTwice) {
  for (const char* fault : {"absolute", "tool"}) {
    SCOPED_TRACE(fault);
    Case now({fault});
    now.controller().knows(now.twin().model().model().calibrated);
    EXPECT_FALSE(now.run());
    EXPECT_EQ(now.controller().counters().largest_offset_m, 0.0);
    EXPECT_EQ(now.loop().session().state(), SessionState::kFault);
  }
}

/// A controller that begins to correct itself while it is corrected, or repeats old joints.
TEST(Faults, AFaultOnTheWayStaysUntilAnOperatorAcknowledges) {
  for (const char* fault : {"absolute@3+1", "freeze@3+1"}) {
    SCOPED_TRACE(fault);
    Case left_alone({fault});
    left_alone.controller().knows(Case::twin().model().model().calibrated);
    EXPECT_TRUE(left_alone.run());
    left_alone.expect_no_step();
    EXPECT_EQ(left_alone.loop().session().state(), SessionState::kFault);
    EXPECT_EQ(left_alone.controller().receiver().present().translation.norm(), 0.0);

    Case acknowledged({fault, "acknowledge@6+0.3"});
    acknowledged.controller().knows(Case::twin().model().model().calibrated);
    EXPECT_TRUE(course_of(acknowledged).came_back);
    acknowledged.expect_no_step();
    EXPECT_EQ(acknowledged.loop().session().state(), SessionState::kActive);
  }
}

TEST(Faults, AProtectiveStopAndDrivesOffLeaveTheArmWhereItIsAndItGoesOn) {
  for (const char* fault : {"stop@3+2", "drives-off@3+2"}) {
    SCOPED_TRACE(fault);
    Case now({fault});
    EXPECT_TRUE(course_of(now).came_back);
    now.expect_no_step();
    EXPECT_TRUE(now.controller().done());
    EXPECT_EQ(now.loop().session().state(), SessionState::kActive);
  }
}

TEST(Faults, InShadowNothingIsCorrected) {
  Case now({}, {.mode = drivers::CorrectionMode::kShadow});
  EXPECT_FALSE(now.run());
  EXPECT_EQ(now.controller().counters().largest_offset_m, 0.0);
  EXPECT_EQ(now.loop().session().state(), SessionState::kShadow);
}

}  // namespace
}  // namespace plumb::offline::twin
