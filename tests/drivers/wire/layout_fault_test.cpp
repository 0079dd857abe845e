// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/session_inputs.hpp"

namespace plumb::drivers {
namespace {

/// "message.key" of every fault.
using Names = std::vector<std::string>;
Names faults(const BusLayout& layout, BusUse use = BusUse::kCan) {
  Names out;
  for (const LayoutFault& fault : find_faults(layout, use)) {
    EXPECT_FALSE(fault.what.empty());
    EXPECT_FALSE(fault.help.empty());
    EXPECT_NE(fault.what.back(), '.');
    out.push_back(fault.message + "." + fault.key);
  }
  return out;
}

MessageLayout& at(BusLayout& layout, const std::string& name) {
  for (MessageLayout& message : layout.messages)
    if (message.name == name) return message;
  throw std::runtime_error(name);
}

BusLayout with(const std::function<void(BusLayout&)>& change) {
  BusLayout out = default_layout(6, 0.004);
  change(out);
  return out;
}

TEST(LayoutFaults, ThereAreNoneInTheDefaultLayoutForAnyArmAt250HzAndInFdAt1kHz) {
  for (int joints = 1; joints <= 9; ++joints)
    for (const int temperatures : {0, 8})
      for (const auto form : {CorrectionForm::kPose, CorrectionForm::kOffset}) {
        BusLayout layout = default_layout(joints, 0.004, temperatures, form);
        EXPECT_EQ(faults(layout), Names{}) << joints;
        EXPECT_EQ(faults(layout, BusUse::kModbus), Names{}) << joints;
        layout = default_layout(joints, 0.001, temperatures, form);
        layout.can_format = CanFrame::Format::kFd;
        EXPECT_EQ(faults(layout), Names{}) << joints;
        std::printf("%d joints, %d temperatures: FD at 1 kHz %.0f %%\n", joints, temperatures,
                    100 * worst_bus_load(layout));
      }
}

TEST(LayoutFaults, ClassicOffsetsOfSixAxesFitAt500HzAndPosesDoNotAt1kHz) {
  EXPECT_EQ(faults(default_layout(6, 0.002, 0, CorrectionForm::kOffset)), Names{});
  EXPECT_EQ(faults(default_layout(6, 0.001)), Names{".load"});
  EXPECT_EQ(faults(default_layout(6, 0.001), BusUse::kModbus), Names{});
}

TEST(LayoutFaults, IdentifiersStayInTheirRange) {
  EXPECT_EQ(faults(with([](auto& l) { at(l, "target").can_id = 0x7FD; })), Names{});
  EXPECT_EQ(faults(with([](auto& l) { at(l, "target").can_id = 0x7FE; })), Names{"target.can_id"});
  EXPECT_EQ(faults(with([](auto& l) { at(l, "target").can_id = 0xFFFFFFFF; })),
            Names{"target.can_id"});
  const auto extended = [](std::uint32_t id) {
    return with([id](auto& l) {
      l.id_kind = CanFrame::Id::kExtended;
      at(l, "target").can_id = id;
    });
  };
  EXPECT_EQ(faults(extended(0x1FFFFFFD)), Names{});
  EXPECT_EQ(faults(extended(0x1FFFFFFE)), Names{"target.can_id"});
}

TEST(LayoutFaults, SpansOfFramesAndRegistersStayApart) {
  const auto joints_at = [](std::uint32_t id) {
    return with([id](auto& l) { at(l, "joints").can_id = id; });
  };
  // target: 0x118 to 0x11A; joints has three frames too
  EXPECT_EQ(faults(joints_at(0x115)), Names{});
  EXPECT_EQ(faults(joints_at(0x116)), Names{"joints.can_id"});
  EXPECT_EQ(faults(joints_at(0x11A)), Names{"joints.can_id"});
  EXPECT_EQ(faults(joints_at(0x11B)), Names{});
  const auto target_at = [](std::uint16_t first) {
    return with([first](auto& l) { at(l, "target").first_register = first; });
  };
  // joints: 1000 to 1014; target has fifteen registers too
  EXPECT_EQ(faults(target_at(1015)), Names{});
  EXPECT_EQ(faults(target_at(1014)), Names{"joints.register"});
  EXPECT_EQ(faults(target_at(986)), Names{"joints.register"});
  EXPECT_EQ(faults(target_at(985)), Names{});
  EXPECT_EQ(faults(target_at(65521)), Names{});
  EXPECT_EQ(faults(target_at(65522)), Names{"target.register"});
}

TEST(LayoutFaults, ScalesPeriodsAndRatesAreAboveZero) {
  for (const double bad : {0.0, -1e-6, double{NAN}, double{INFINITY}}) {
    EXPECT_EQ(faults(with([&](auto& l) { at(l, "target").signals[2].scale = bad; })),
              Names{"target.scale"});
    EXPECT_EQ(faults(with([&](auto& l) { at(l, "joints").period_s = bad; })),
              Names{"joints.period_us"});
    EXPECT_EQ(faults(with([&](auto& l) { l.bit_rate = bad; })), Names{".bit_rate"});
    EXPECT_EQ(faults(with([&](auto& l) {
                l.can_format = CanFrame::Format::kFd;
                l.data_bit_rate = bad;
              })),
              Names{".data_bit_rate"});
  }
}

TEST(LayoutFaults, NoMessageIsSoSeldomThatItsSenderCountsAsSilent) {
  for (const MessageLayout& message : default_layout(6, 0.004).messages) {
    const auto every = [&](double period_s) {
      return faults(with([&](auto& l) { at(l, message.name).period_s = period_s; }),
                    BusUse::kModbus);
    };
    const double most_s = std::min(100.0, 0.5 * longest_silence_s(message.kind));
    EXPECT_EQ(every(most_s), Names{}) << message.name;
    const bool ever = std::isinf(longest_silence_s(message.kind));
    EXPECT_EQ(every(1.01 * most_s), ever ? Names{} : Names{message.name + ".period_us"});
  }
  // a cycle that is too slow is one of every message that has the cycle's period
  EXPECT_EQ(faults(default_layout(6, 0.05), BusUse::kModbus), Names{});
  EXPECT_EQ(
      faults(default_layout(6, 0.0501), BusUse::kModbus),
      (Names{"controller.period_us", "target.period_us", "joints.period_us", "status.period_us"}));
}

TEST(LayoutFaults, AMessageHoldsNoMoreThanAFrameOfCanFd) {
  EXPECT_EQ(faults(default_layout(6, 0.004, 9)), Names{});
  EXPECT_EQ(faults(default_layout(6, 0.004, 10)), Names{"context.signals"});
  EXPECT_EQ(faults(with([](auto& l) { at(l, "robot").signals.clear(); })), Names{"robot.signals"});
}

TEST(LayoutFaults, AllOfAKindAreToldAtOnce) {
  EXPECT_EQ(faults(with([](auto& l) {
              at(l, "joints").period_s = 0.0;
              at(l, "target").can_id = 0x800;
              at(l, "robot").signals[0].scale = 0.0;
            })),
            (Names{"target.can_id", "joints.period_us", "robot.scale"}));
}

}  // namespace
}  // namespace plumb::drivers
