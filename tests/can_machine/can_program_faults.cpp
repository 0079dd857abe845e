// SPDX-License-Identifier: Apache-2.0
// The program plumb-rt on a bus. A second sender of our identifiers, end to end: plumb-rt on vcan0,
// a controller beside it, and can-utils' cansend as the intruder. What the doctor says of real
// interfaces. Run by tests/can_machine/can_faults.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/can_machine/two_ports.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt_program.hpp"
#include "tests/drivers/session_rig.hpp"

namespace plumb::tests {
namespace {

const std::string kOnCan =
    "schema = \"rt/1\"\n[cycle]\ncycle_us = 4000\npriority = 0\n[source]\nkind = \"can\"\n"
    "interface = \"vcan0\"\n[limits]\nmode = \"full\"\n";

/// SessionRig's controller on vcan0, on a thread of its own; what it sees of plumb-rt.
class Controller {
 public:
  Controller() : rig_({}, Deployed::arm()), layout_(layout_of(CanFrame::Format::kClassic, 0.004)) {
    rig_.robot = fingerprint(Deployed::arm().serial);
    CanPortOpening opening = CanPort::open("vcan0", layout_, Sender::kController);
    EXPECT_TRUE(opening.port) << describe(opening.step).why;
    if (opening.port) port_.emplace(std::move(*opening.port));
    thread_ = std::thread([this] {
      while (port_ && !ended_) beat();
    });
  }
  ~Controller() {
    ended_ = true;
    thread_.join();
  }

  std::atomic<bool> acknowledge{false};
  std::atomic<int> state{-1};
  std::atomic<long> answers{0};
  std::atomic<double> correction_m{0.0};  // of the last answer
  /// The largest move of the correction from one answer to the next, over the longest time that may
  /// have passed between their computations: from the sending of the earlier target to the hearing
  /// of the later answer, and the two cycles that the guard's clock may be ahead. On a slow machine
  /// a beat takes longer than 4 ms, so time is read from a clock and never counted in beats.
  std::atomic<double> largest_slew_m_s{0.0};

 private:
  void beat() {
    const bool shadow = state == static_cast<int>(SessionState::kShadow);
    rig_.state.acknowledge = acknowledge || (shadow && rig_.counter / 75 % 2 == 1);
    sent_ns_[rig_.counter] = tests::now_ns();
    for (const BusMessage& message : rig_.controller_says()) port_->send(message);
    for (BusMessage message; port_->receive(message);) hear(message);
    ++rig_.counter;
    rig_.swing();
    wait_ms(4);
  }

  void hear(const BusMessage& message) {
    if (message.kind == MessageKind::kStatus) state = static_cast<int>(status_in(message).state);
    const auto X_BC = pose_in(message);
    if (message.kind != MessageKind::kCorrected || !X_BC) return;
    const std::uint16_t target = full(message.counter);
    const Vector3 correction = X_BC->p - rig_.targets[target].p;
    const std::int64_t since_ns = sent_ns_[answers == 0 ? target : last_target_];
    const double passed_s = 1e-9 * static_cast<double>(tests::now_ns() - since_ns + 2 * kCycle_ns);
    const double move_m = (correction - last_).norm();
    largest_slew_m_s = std::max(largest_slew_m_s.load(), (move_m - kGrid_m) / passed_s);
    correction_m = correction.norm();
    last_ = correction;
    last_target_ = target;
    ++answers;
  }

  /// Classic frames carry the lower 8 bits of a counter.
  std::uint16_t full(std::uint16_t counter) const {
    return static_cast<std::uint16_t>(rig_.counter -
                                      static_cast<std::uint8_t>(rig_.counter - counter));
  }

  SessionRig rig_;
  BusLayout layout_;
  std::optional<CanPort> port_;
  static constexpr double kGrid_m = 2e-6;  // two corrections on the wire's grid, a micrometre
  std::vector<std::int64_t> sent_ns_ = std::vector<std::int64_t>(65536);  // of targets, by counter
  Vector3 last_ = Vector3::Zero();
  std::uint16_t last_target_ = 0;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

class ASecondSender : public testing::Test {
 protected:
  ASecondSender() : run({"run", folder.folder.string(), "--json"}, folder.folder) {}

  bool comes(SessionState state) {
    return becomes([&] { return controller.state == static_cast<int>(state); });
  }
  bool corrects() {
    return becomes([&] {
      return controller.state == static_cast<int>(SessionState::kActive) &&
             controller.correction_m > kClear_m;
    });
  }
  /// A push of the button.
  void acknowledge() {
    controller.acknowledge = true;
    wait_ms(300);
    controller.acknowledge = false;
    wait_ms(200);
  }
  nlohmann::json status() const {
    return plumb_rt({"status", folder.folder.string(), "--json"}, folder.folder).json()["result"];
  }

  static constexpr double kClear_m = 2e-4;  // the arm's own errors are half a millimetre
  /// What the last answer may leave: plumb-rt's own steps are two cycles of slew at most.
  static inline const double kLastStep_m = 2.0 * 0.004 * Deployed::arm().guard.slew_m_per_s + 2e-6;
  Deployed folder{kOnCan};
  Controller controller;
  RtProgram run;
};

TEST_F(ASecondSender, OfACorrectedTargetIsAFaultThatRampsOutAndWaitsForAnOperator) {
  ASSERT_TRUE(corrects());
  must("cansend vcan0 700#0011223344556677");
  must("cansend vcan0 118#");  // the controller's own identifier, and no message: merely corrupt
  wait_ms(200);
  ASSERT_EQ(controller.state, static_cast<int>(SessionState::kActive)) << "it is none of ours";

  const std::int64_t begin_ns = now_ns();
  must("cansend vcan0 130#0000000000000000");
  ASSERT_TRUE(comes(SessionState::kFault));
  std::printf("cansend to FAULT: %.0f ms\n", 1e-6 * static_cast<double>(now_ns() - begin_ns));
  ASSERT_TRUE(becomes([&] { return controller.correction_m <= kLastStep_m; }))
      << controller.correction_m;
  wait_ms(300);
  const long answers = controller.answers;
  wait_ms(1500);  // longer than the intruder counts
  EXPECT_EQ(controller.answers, answers) << "without a correction nothing is answered";
  EXPECT_EQ(controller.state, static_cast<int>(SessionState::kFault)) << "nobody acknowledged";
  const auto seen = status();
  EXPECT_EQ(seen["fault"], "foreign-sender");
  EXPECT_EQ(seen["link"]["foreign_senders"], 1);
  EXPECT_EQ(seen["counters"]["faults"], 1);
  EXPECT_EQ(seen["correction"]["applied_um"], 0.0);

  for (int i = 0; i < 4; ++i) {  // the cause goes on
    must("cansend vcan0 132#0000000000000000");
    acknowledge();
    EXPECT_EQ(controller.state, static_cast<int>(SessionState::kFault));
  }
  wait_ms(1500);
  acknowledge();
  EXPECT_TRUE(corrects());
  EXPECT_EQ(status()["fault"], "none");
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
  EXPECT_LT(controller.largest_slew_m_s, Deployed::arm().guard.slew_m_per_s)
      << "the correction stepped";
}

TEST_F(ASecondSender, OfAStatusIsAFaultToo) {
  ASSERT_TRUE(corrects());
  must("cansend vcan0 140#0000000000000000");
  EXPECT_TRUE(comes(SessionState::kFault));
  EXPECT_EQ(status()["fault"], "foreign-sender");
}

TEST(Doctor, SaysOfRealInterfacesWhetherTheyAreUpAndHowFast) {
  const auto seen = [] {
    const std::filesystem::path scratch = std::filesystem::temp_directory_path();
    const auto json = plumb_rt({"doctor", "--json"}, scratch).json();
    nlohmann::json out;
    for (const auto& one : json["result"]["can_interfaces"]) out[one["name"]] = one;
    return out;
  };
  auto interfaces = seen();
  EXPECT_EQ(interfaces["can0"]["kind"], "can");
  EXPECT_EQ(interfaces["can0"]["state"], "up");
  EXPECT_EQ(interfaces["can0"]["bit_rate"], 500'000);  // --bitrate 500000
  EXPECT_EQ(interfaces["can0"]["restart_ms"], 100);
  EXPECT_EQ(interfaces["vcan0"]["state"], "up");
  EXPECT_EQ(interfaces["vcan0"]["bit_rate"], nullptr);
  must("ip link set can1 down");
  EXPECT_EQ(seen()["can1"]["state"], "down");
  must("ip link set can1 up");
  EXPECT_EQ(seen()["can1"]["state"], "up");
}

}  // namespace
}  // namespace plumb::tests
