// SPDX-License-Identifier: Apache-2.0
// What a bus can do to frames, with the kernel's own network emulator. Run by
// tests/can_machine/can_faults on the emulated machine.
#include <gtest/gtest.h>

#include "tests/can_machine/two_ports.hpp"

namespace plumb::tests {
namespace {

class OnABadBus : public testing::TestWithParam<CanFrame::Format> {
 protected:
  void fault(const std::string& netem) { must("tc qdisc add dev right root netem " + netem); }
  void mend() { must("tc qdisc del dev right root"); }

  void print(const char* what) {
    const PortCounters counters = ports.plumb().counters();
    std::printf("%s: %d sent, %d heard, %llu skipped, %llu repeated, %llu corrupt\n", what,
                ports.next(), ports.heard(), wide(counters.skipped), wide(counters.repeated),
                wide(counters.corrupt));
  }

  /// Nothing that was in the emulator when it went is heard after this.
  void recovers() {
    const double ms = ports.recovery_ms();
    std::printf("mended: heard again after %.1f ms\n", ms);
    EXPECT_GE(ms, 0.0);
    EXPECT_LT(ms, 500.0);
  }

  TwoPorts ports{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Can, OnABadBus,
                         testing::Values(CanFrame::Format::kClassic, CanFrame::Format::kFd),
                         [](const auto& one) {
                           return one.param == CanFrame::Format::kFd ? "Fd" : "Classic";
                         });

TEST_P(OnABadBus, EveryTargetArrivesWhenNothingIsWrong) {
  ports.run(200);
  print("no fault");
  EXPECT_EQ(ports.heard(), 200);
  EXPECT_EQ(ports.plumb().counters().skipped, 0U);
}

TEST_P(OnABadBus, OfLostFramesOnlyWholeTargetsAreHeardAndTheOthersCounted) {
  ports.run(10);
  fault("loss 30%");
  ports.run(600);
  mend();
  recovers();
  print("30 % lost");
  // a target is one frame of FD, or three classic ones: 0.7 and 0.7^3 = 0.34 of them, 4 sigma
  const double share = static_cast<double>(ports.heard() - 11) / 600.0;
  const double expected = GetParam() == CanFrame::Format::kFd ? 0.7 : 0.343;
  EXPECT_NEAR(share, expected, 0.08);
  EXPECT_EQ(ports.plumb().counters().skipped + static_cast<unsigned>(ports.heard()),
            static_cast<unsigned>(ports.next()));
}

TEST_P(OnABadBus, DelayedFramesHaveTheTimeOfTheirArrival) {
  fault("delay 20ms");
  ports.run(200);
  wait_ms(100);
  ports.take_all();
  print("20 ms late");
  EXPECT_EQ(ports.heard(), 200);
  mend();
  recovers();
}

TEST_P(OnABadBus, RepeatedFramesAreHeardOnce) {
  fault("duplicate 50%");
  ports.run(300);
  print("50 % twice");
  EXPECT_EQ(ports.heard(), 300);
  EXPECT_GT(ports.plumb().counters().repeated, 100U);
  EXPECT_EQ(ports.plumb().counters().skipped, 0U);
}

TEST_P(OnABadBus, AnOvertakenTargetIsNeverHeardAfterANewerOne) {
  fault("delay 5ms reorder 50% 50%");
  ports.run(500);
  wait_ms(50);
  ports.take_all();
  print("50 % overtaken");
  EXPECT_GT(ports.heard(), 50);
  EXPECT_GT(ports.plumb().counters().repeated, 0U);
  mend();
  recovers();
}

TEST_P(OnABadBus, BentFramesAreNotHeard) {
  fault("corrupt 30%");  // one bit anywhere: data, length, identifier, padding
  ports.run(600);
  mend();
  recovers();
  print("30 % bent");
  EXPECT_GT(ports.plumb().counters().corrupt, 30U);
  EXPECT_GT(ports.heard(), 100);
}

}  // namespace
}  // namespace plumb::tests
