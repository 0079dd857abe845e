// SPDX-License-Identifier: Apache-2.0
#include "twin/receiver.hpp"

#include <gtest/gtest.h>

#include "plumb/drivers/bus_content.hpp"
#include "twin/transforms.hpp"

namespace plumb::offline::twin {
namespace {

using drivers::MessageKind;

constexpr std::int64_t kCycle_ns = 4'000'000;
constexpr double kCycle_s = 0.004;

Isometry3d at(double x_m) {
  Isometry3d out = Isometry3d::Identity();
  out.translation().x() = x_m;
  return out;
}

drivers::BusMessage corrected(double x_m, std::uint16_t counter) {
  return drivers::pose_message(MessageKind::kCorrected, to_transform(at(x_m)), counter);
}

/// A receiver and the target that it sends, which moves along x by 4 mm a cycle (1 m/s).
class Line {
 public:
  std::uint16_t cycle() {
    ++counter_;
    now_ns_ += kCycle_ns;
    receiver.sent(counter_, at(x_m()), now_ns_);
    return counter_;
  }
  double x_m() const { return 0.004 * counter_; }
  double step() {
    const double before_m = receiver.present().translation.norm();
    const double now_m = receiver.step(now_ns_, kCycle_s).translation.norm();
    largest_m = std::max(largest_m, std::abs(now_m - before_m));
    return now_m;
  }
  void hear(const drivers::BusMessage& message) { receiver.hear(message, now_ns_); }
  std::int64_t now_ns() const { return now_ns_; }

  Receiver receiver{Receiver::Settings{}};
  double largest_m = 0.0;

 private:
  std::uint16_t counter_ = 0;
  std::int64_t now_ns_ = 0;
};

TEST(Receiver, AppliesTheDifferenceFromTheTargetThatWasMeant) {
  Line line;
  for (int k = 0; k < 200; ++k) {
    const double meant_m = line.x_m();  // of the cycle before: the answer takes a cycle
    const auto counter = static_cast<std::uint16_t>(line.cycle() - 1);
    if (k > 0) line.hear(corrected(meant_m + 0.001, counter));
    line.step();
  }
  EXPECT_NEAR(line.receiver.present().translation.x(), 0.001, 1e-12);
  EXPECT_LE(line.largest_m, Receiver::Settings{}.slew_m_per_s * kCycle_s * 1.0001);
}

TEST(Receiver, UnderstandsOffsetsAsWell) {
  Line line;
  for (int k = 0; k < 200; ++k) {
    const auto counter = line.cycle();
    const Transformd X_BD = to_transform(at(line.x_m()));
    const Transformd X_BC = to_transform(at(line.x_m() + 0.002));
    line.hear(drivers::offset_message(X_BD, X_BC, counter));
    line.step();
  }
  EXPECT_NEAR(line.receiver.present().translation.x(), 0.002, 1e-9);
}

TEST(Receiver, RampsOutWithoutAStepWhenTheSenderDies) {
  Line line;
  for (int k = 0; k < 200; ++k) {
    const auto counter = line.cycle();
    line.hear(corrected(line.x_m() + 0.003, counter));
    line.step();
  }
  line.largest_m = 0.0;
  for (int k = 0; k < 200; ++k) {
    line.cycle();
    line.step();
  }
  EXPECT_EQ(line.receiver.present().translation.norm(), 0.0);
  EXPECT_GT(line.largest_m, 0.0);
  EXPECT_LE(line.largest_m, Receiver::Settings{}.slew_m_per_s * kCycle_s * 1.0001);
}

TEST(Receiver, RefusesWhatIsOldLargeOvertakenOrNoNumber) {
  Line line;
  const auto first = line.cycle();
  const double first_m = line.x_m();
  const auto second = line.cycle();
  line.hear(corrected(line.x_m() + 0.001, second));
  line.hear(corrected(first_m + 0.002, first));
  EXPECT_EQ(line.receiver.counters().overtaken, 1U);
  line.hear(corrected(line.x_m() + 0.011, second));
  auto nothing = corrected(0.0, second);
  nothing.values[1] = NAN;
  line.hear(nothing);
  EXPECT_EQ(line.receiver.counters().too_large, 2U);
  line.hear(corrected(1.0, static_cast<std::uint16_t>(second + 1)));  // never sent
  for (int k = 0; k < 30; ++k) line.cycle();
  line.hear(corrected(0.008 + 0.001, second));  // 0.12 s ago
  EXPECT_EQ(line.receiver.counters().stale, 2U);
  EXPECT_EQ(line.receiver.counters().used, 1U);
  EXPECT_FALSE(line.receiver.fresh(line.now_ns()));
}

TEST(Receiver, AfterARebootOldAnswersMeanNothing) {
  Line line;
  const auto counter = line.cycle();
  line.receiver.forget();
  line.hear(corrected(line.x_m() + 0.001, counter));
  EXPECT_EQ(line.receiver.counters().stale, 1U);
}

TEST(Receiver, OffsetsAndPosesAreTheSameThing) {
  Isometry3d X_BD = at(0.5), X_BC = at(0.5012);
  X_BD.linear() = Eigen::AngleAxisd(1.0, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  X_BC.linear() = (Eigen::AngleAxisd(1e-3, Vector3d(0, 1, 1).normalized()) * X_BD.linear()).eval();
  const Offset offset = offset_between(X_BD, X_BC);
  EXPECT_NEAR(offset.rotation.norm(), 1e-3, 1e-12);
  EXPECT_TRUE(applied(offset, X_BD).isApprox(X_BC, 1e-12));
}

}  // namespace
}  // namespace plumb::offline::twin
