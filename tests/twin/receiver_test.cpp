// SPDX-License-Identifier: Apache-2.0
// The receiver against docs/safety.md: one test for each of its numbered sentences.
#include "twin/receiver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <string>

#include "plumb/drivers/can_codec.hpp"
#include "twin/transforms.hpp"

namespace plumb::offline::twin {
namespace {

using drivers::MessageKind;
using drivers::SessionState;

constexpr std::int64_t kCycle_ns = 4'000'000;
constexpr double kCycle_s = 0.004;
const double kStep_m = Receiver::Settings{}.slew_m_per_s * kCycle_s * 1.0001;

Isometry3d at(double x_m) {
  Isometry3d out = Isometry3d::Identity();
  out.translation().x() = x_m;
  return out;
}

drivers::BusMessage corrected(double x_m, std::uint16_t counter) {
  return drivers::pose_message(MessageKind::kCorrected, to_transform(at(x_m)), counter);
}

/// A receiver and the target that it sends, which moves along x by 4 mm a cycle (1 m/s), and a
/// plumb-rt that sends its status every cycle and answers nothing by itself.
class Line {
 public:
  std::uint16_t cycle() {
    ++counter_;
    now_ns_ += kCycle_ns;
    receiver.sent(counter_, at(x_m()), now_ns_);
    if (beats) hear(drivers::status_message(status, ++beat_));
    return counter_;
  }
  double x_m() const { return 0.004 * counter_; }
  double step() {
    const double before_m = offset_m();
    receiver.step(now_ns_, kCycle_s, own);
    largest_m = std::max(largest_m, std::abs(offset_m() - before_m));
    return offset_m();
  }
  /// So many cycles in which every target is answered at once, `more_m` beside it.
  void answered(int cycles, double more_m) {
    for (int k = 0; k < cycles; ++k) {
      const auto counter = cycle();
      hear(corrected(x_m() + more_m, counter));
      step();
    }
  }
  void silent(int cycles) {
    for (int k = 0; k < cycles; ++k) cycle(), step();
  }
  double offset_m() const { return receiver.present().translation.x(); }
  void hear(const drivers::BusMessage& message) { receiver.hear(message, now_ns_); }
  std::int64_t now_ns() const { return now_ns_; }

  Receiver receiver{Receiver::Settings{}};
  Receiver::Own own;
  drivers::SessionStatus status{.state = SessionState::kActive, .has_output = true};
  bool beats = true;
  double largest_m = 0.0;

 private:
  std::uint16_t counter_ = 0;
  std::uint16_t beat_ = 0;
  std::int64_t now_ns_ = 0;
};

/// The numbered sentences of docs/safety.md, each on one line.
std::map<int, std::string> sentences() {
  std::ifstream in(PLUMB_SOURCE_DIR "/docs/safety.md");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto from = text.find("## What the controller's side must do");
  text = text.substr(from, text.find("## What the integrator configures") - from);
  std::map<int, std::string> out;
  int number = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (std::regex_match(line, found, std::regex(R"(\s*(\d+)\. (.*))"))) {
      number = std::stoi(found[1]);
      out[number] = found[2];
    } else if (number > 0 && line.starts_with(" ")) {
      out[number] += " " + line.substr(line.find_first_not_of(' '));
    } else {
      number = 0;
    }
  }
  return out;
}

struct Said {
  int number;
  const char* sentence;
};
constexpr Said kSaid[] = {
    {1,
     "The receiver remembers the last 64 targets that it sent, each with its counter and when it "
     "was sent."},
    {2,
     "An answer is counted and dropped if its check sum is wrong, if it belongs to no remembered "
     "target or to one sent more than 100 ms ago, or if a later target was answered before."},
    {3,
     "What is wanted is the difference of an answer from its own target; an answer is never used "
     "as a position, because an old one would pull the arm back to where it was."},
    {4,
     "A difference larger than the largest correction, or one that is no number, is counted and "
     "dropped."},
    {5,
     "Beyond 100 ms since its target was sent, by the receiver's own clock, what is wanted is "
     "used no longer."},
    {6,
     "plumb-rt is alive if a status whose counter differs from the one before came within the "
     "last 100 ms; the first status alone proves nothing."},
    {7, "The goal is zero unless the last status says output, in the state ACTIVE or HOLD."},
    {8,
     "The offset moves towards the goal by the slew limit of the model at most: in, out and in "
     "between."},
    {9,
     "The command is the present target with the offset on it: translation added, rotation R = "
     "exp(r) R_target."},
    {10,
     "The offset starts at zero whenever the receiver starts, drives go off, or the program is "
     "changed; nothing heard before counts after a start or a change."},
    {11, "With drives off the offset is zero at once and stays zero, whatever is heard."},
    {12,
     "In manual mode the offset goes to zero by the slew limit and stays zero, whatever is "
     "heard."},
    {13,
     "Once a status says FAULT, the goal is zero until the operator has pressed the controller's "
     "own button after that, and a later status says another state."},
};

TEST(Receiver, EverySentenceOfTheDocumentIsTestedHere) {
  const auto written = sentences();
  EXPECT_EQ(written.size(), std::size(kSaid));
  for (const Said& said : kSaid) {
    ASSERT_TRUE(written.contains(said.number)) << said.number;
    EXPECT_EQ(written.at(said.number), said.sentence);
  }
}

TEST(Receiver, Says1TheLast64TargetsAreRemembered) {
  Receiver::Settings patient;
  patient.fresh_s = 10.0;
  for (const int back : {63, 64}) {
    Receiver receiver(patient);
    for (int k = 0; k <= 100; ++k)
      receiver.sent(static_cast<std::uint16_t>(k), at(0.004 * k), k * kCycle_ns);
    receiver.hear(corrected(0.004 * (100 - back) + 0.001, static_cast<std::uint16_t>(100 - back)),
                  100 * kCycle_ns);
    EXPECT_EQ(receiver.counters().used, back == 63 ? 1U : 0U) << back;
    EXPECT_EQ(receiver.counters().stale, back == 63 ? 0U : 1U) << back;
  }
}

TEST(Receiver, Says2WhatIsBentUnknownOldOrOvertakenIsCountedAndDropped) {
  Line line;
  const auto first = line.cycle();
  const double first_m = line.x_m();
  const auto second = line.cycle();
  const double second_m = line.x_m();
  line.hear(corrected(second_m + 0.001, second));
  line.hear(corrected(first_m + 0.002, first));
  EXPECT_EQ(line.receiver.counters().overtaken, 1U);
  line.hear(corrected(1.0, static_cast<std::uint16_t>(second + 1)));  // never sent
  EXPECT_EQ(line.receiver.counters().stale, 1U);
  for (int k = 0; k < 26; ++k) line.cycle();  // 104 ms
  line.hear(corrected(second_m + 0.001, second));
  EXPECT_EQ(line.receiver.counters().stale, 2U);
  EXPECT_EQ(line.receiver.counters().used, 1U);

  // A wrong check sum never gets past the codec of the bus.
  const auto layout = drivers::default_layout(6, kCycle_s);
  drivers::CanCodec sender(layout), codec(layout);
  int complete = 0, corrupt = 0;
  for (drivers::CanFrame frame : sender.encode(corrected(0.001, 7))) {
    frame.data[0] ^= 1U;
    drivers::BusMessage message;
    const auto heard = codec.hear(frame, message);
    complete += heard == drivers::Heard::kComplete ? 1 : 0;
    corrupt += heard == drivers::Heard::kCorrupt ? 1 : 0;
  }
  EXPECT_EQ(complete, 0);
  EXPECT_GT(corrupt, 0);
}

TEST(Receiver, Says3TheDifferenceFromTheTargetThatWasMeantIsWanted) {
  Line line;
  for (int k = 0; k < 200; ++k) {
    const double meant_m = line.x_m();  // of the cycle before: the answer takes a cycle
    const auto counter = static_cast<std::uint16_t>(line.cycle() - 1);
    if (k > 0) line.hear(corrected(meant_m + 0.001, counter));
    line.step();
  }
  EXPECT_NEAR(line.offset_m(), 0.001, 1e-12);
  Line offsets;
  for (int k = 0; k < 200; ++k) {
    const auto counter = offsets.cycle();
    const Transformd X_BD = to_transform(at(offsets.x_m()));
    const Transformd X_BC = to_transform(at(offsets.x_m() + 0.002));
    offsets.hear(drivers::offset_message(X_BD, X_BC, counter));
    offsets.step();
  }
  EXPECT_NEAR(offsets.offset_m(), 0.002, 1e-9);
}

TEST(Receiver, Says4WhatIsTooLargeOrNoNumberIsCountedAndDropped) {
  Line line;
  const auto counter = line.cycle();
  line.hear(corrected(line.x_m() + 0.011, counter));
  auto nothing = corrected(0.0, counter);
  nothing.values[1] = NAN;
  line.hear(nothing);
  EXPECT_EQ(line.receiver.counters().too_large, 2U);
  EXPECT_EQ(line.receiver.counters().used, 0U);
}

TEST(Receiver, Says5WhatIsOlderThan100MsIsUsedNoLonger) {
  Line line;
  line.answered(100, 0.003);
  line.silent(25);
  EXPECT_NEAR(line.offset_m(), 0.003, 1e-12) << "100 ms after its target was sent";
  line.silent(1);
  EXPECT_LT(line.offset_m(), 0.003);
  line.silent(100);
  EXPECT_EQ(line.offset_m(), 0.0);
}

TEST(Receiver, Says6WithoutANewStatusFor100MsTheGoalIsZero) {
  Line line;
  line.answered(100, 0.003);
  line.beats = false;
  line.answered(25, 0.003);
  EXPECT_NEAR(line.offset_m(), 0.003, 1e-12);
  line.answered(1, 0.003);
  EXPECT_LT(line.offset_m(), 0.003) << "answers alone are no heart-beat";
  line.answered(100, 0.003);
  EXPECT_EQ(line.offset_m(), 0.0);
  for (int k = 0; k < 100; ++k) {
    line.hear(drivers::status_message(line.status, 77));  // one status, repeated for ever
    line.answered(1, 0.003);
  }
  EXPECT_EQ(line.offset_m(), 0.0);
  Line first;
  first.beats = false;
  for (int k = 0; k < 20; ++k) {
    first.hear(drivers::status_message(first.status, 5));
    first.answered(1, 0.003);
  }
  EXPECT_EQ(first.offset_m(), 0.0) << "the first status alone";
}

TEST(Receiver, Says7OnlyOutputInTwoStatesIsFollowed) {
  for (const auto state : {SessionState::kInit, SessionState::kSync, SessionState::kShadow,
                           SessionState::kActive, SessionState::kHold, SessionState::kFault})
    for (const bool output : {false, true}) {
      Line line;
      line.status = {.state = state, .has_output = output};
      line.answered(100, 0.003);
      const bool follows =
          output && (state == SessionState::kActive || state == SessionState::kHold);
      EXPECT_NEAR(line.offset_m(), follows ? 0.003 : 0.0, 1e-12) << static_cast<int>(state);
      line.status = {.state = SessionState::kShadow};
      line.answered(100, 0.003);
      EXPECT_EQ(line.offset_m(), 0.0);
    }
}

TEST(Receiver, Says8TheOffsetNeverMovesFasterThanTheSlewLimit) {
  Line line;
  line.answered(100, 0.003);
  line.answered(100, -0.003);
  line.answered(100, 0.009);
  line.silent(200);
  EXPECT_EQ(line.offset_m(), 0.0);
  EXPECT_GT(line.largest_m, 0.99 * kStep_m);
  EXPECT_LE(line.largest_m, kStep_m);
}

TEST(Receiver, Says9TheOffsetActsOnThePresentTarget) {
  Isometry3d X_BD = at(0.5), X_BC = at(0.5012);
  X_BD.linear() = Eigen::AngleAxisd(1.0, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  X_BC.linear() = (Eigen::AngleAxisd(1e-3, Vector3d(0, 1, 1).normalized()) * X_BD.linear()).eval();
  const Offset offset = offset_between(X_BD, X_BC);
  EXPECT_NEAR(offset.rotation.norm(), 1e-3, 1e-12);
  EXPECT_TRUE(applied(offset, X_BD).isApprox(X_BC, 1e-12));
  const Isometry3d elsewhere = applied({Vector3d(1e-3, 0, 0), Vector3d::Zero()}, at(2.0));
  EXPECT_NEAR(elsewhere.translation().x(), 2.001, 1e-12);
}

TEST(Receiver, Says10AStartAndDrivesOffBeginAtZeroAndForget) {
  Line line;
  EXPECT_EQ(line.receiver.present().translation.norm(), 0.0);
  line.answered(100, 0.003);
  const auto counter = line.cycle();
  line.receiver.restart();
  EXPECT_EQ(line.offset_m(), 0.0);
  line.hear(corrected(line.x_m() + 0.001, counter));
  EXPECT_EQ(line.receiver.counters().stale, 1U);
  line.step();
  EXPECT_EQ(line.offset_m(), 0.0);
  EXPECT_FALSE(line.receiver.alive(line.now_ns()));
  line.answered(100, 0.003);
  line.own.drives_on = false;
  line.answered(1, 0.003);
  EXPECT_EQ(line.offset_m(), 0.0);
  line.own.drives_on = true;
  line.answered(1, 0.003);
  EXPECT_LE(line.offset_m(), kStep_m) << "from zero, and by the slew limit";
}

TEST(Receiver, Says11WithDrivesOffTheOffsetIsZero) {
  Line line;
  line.answered(100, 0.003);
  line.own.drives_on = false;
  for (int k = 0; k < 100; ++k) {
    line.answered(1, 0.003);
    EXPECT_EQ(line.offset_m(), 0.0);
  }
}

TEST(Receiver, Says12InManualModeTheOffsetGoesOutAndStaysOut) {
  Line line;
  line.answered(100, 0.003);
  line.own.automatic = false;
  line.largest_m = 0.0;
  line.answered(100, 0.003);
  EXPECT_EQ(line.offset_m(), 0.0);
  EXPECT_LE(line.largest_m, kStep_m);
  line.answered(100, 0.003);
  EXPECT_EQ(line.offset_m(), 0.0);
}

/// Whoever writes answers and states in the name of a plumb-rt that is in FAULT.
TEST(Receiver, Says13AfterAFaultNothingIsFollowedUntilTheOperatorHasPressed) {
  Line line;
  line.answered(100, 0.003);
  line.status.state = SessionState::kFault;
  line.answered(1, 0.003);
  line.status.state = SessionState::kActive;
  line.answered(1000, 0.0055);
  EXPECT_EQ(line.offset_m(), 0.0) << "forged";
  EXPECT_LE(line.largest_m, kStep_m);

  line.status.state = SessionState::kFault;
  line.own.acknowledge = true;
  line.answered(50, 0.003);
  EXPECT_EQ(line.offset_m(), 0.0) << "acknowledged, and still in FAULT";
  line.own.acknowledge = false;
  line.status.state = SessionState::kActive;
  line.answered(100, 0.003);
  EXPECT_NEAR(line.offset_m(), 0.003, 1e-12);
}

TEST(Receiver, AButtonThatIsStuckAcknowledgesNothing) {
  Line line;
  line.own.acknowledge = true;
  line.answered(10, 0.003);
  line.status.state = SessionState::kFault;
  line.answered(10, 0.003);
  line.status.state = SessionState::kActive;
  line.answered(200, 0.003);
  EXPECT_EQ(line.offset_m(), 0.0);
}

}  // namespace
}  // namespace plumb::offline::twin
