// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_interface.hpp"

#include <gtest/gtest.h>

#include <cerrno>

#include "plumb/drivers/can_step.hpp"

namespace plumb::drivers {
namespace {

CanInterface good() {
  return {.name = "can0",
          .kind = "can",
          .up = true,
          .carrier = true,
          .fd = true,
          .bit_rate = 1'000'000,
          .data_bit_rate = 4'000'000,
          .restart_ms = 100};
}

BusLayout fd_layout() {
  BusLayout out;
  out.can_format = CanFrame::Format::kFd;
  out.bit_rate = 1e6;
  out.data_bit_rate = 4e6;
  return out;
}

constexpr char kFdRemedy[] =
    "sudo ip link set can0 down && sudo ip link set can0 up type can bitrate 1000000 dbitrate "
    "4000000 fd on restart-ms 100";

TEST(CanInterface, FitsWhenRatesAndFormatAgree) {
  EXPECT_TRUE(misfits(fd_layout(), good()).empty());
  CanInterface close = good();
  close.bit_rate = 998'000;  // as near as the controller's clock allows
  EXPECT_TRUE(misfits(fd_layout(), close).empty());
}

TEST(CanInterface, WithoutABitRateFitsEveryLayout) {
  CanInterface interface = good();
  interface.name = interface.kind = "vcan";
  interface.bit_rate = interface.data_bit_rate = interface.restart_ms = {};
  EXPECT_TRUE(misfits(fd_layout(), interface).empty());
}

TEST(CanInterface, ThatIsDownOrClassicOrOfAnotherRateIsRefusedWithTheCommandThatSetsItUp) {
  for (int fault = 0; fault < 4; ++fault) {
    CanInterface interface = good();
    if (fault == 0) interface.up = false;
    if (fault == 1) interface.fd = false;
    if (fault == 2) interface.bit_rate = 500'000;
    if (fault == 3) interface.data_bit_rate = 2'000'000;
    const auto found = misfits(fd_layout(), interface);
    ASSERT_EQ(found.size(), 1U) << fault;
    EXPECT_EQ(found[0].grant, Grant::kDenied);
    EXPECT_EQ(found[0].remedy, kFdRemedy);
  }
  CanInterface slow = good();
  slow.bit_rate = 500'000;
  EXPECT_EQ(misfits(fd_layout(), slow)[0].why,
            "the bit rate is 500000 bit/s, the layout says 1000000 bit/s");
}

TEST(CanInterface, ThatDoesNotRestartIsOnlyRemarked) {
  CanInterface interface = good();
  interface.restart_ms = 0;
  const auto found = misfits(fd_layout(), interface);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].grant, Grant::kSkipped);
  EXPECT_EQ(found[0].why, "can0 stays bus-off until someone restarts it");
}

TEST(CanInterface, OfAClassicLayoutMayHaveAnyDataRate) {
  BusLayout layout = fd_layout();
  layout.can_format = CanFrame::Format::kClassic;
  CanInterface interface = good();
  interface.fd = false;
  interface.data_bit_rate = {};
  EXPECT_TRUE(misfits(layout, interface).empty());
}

TEST(CanInterface, IsNotFoundUnderANameThatNoneHas) { EXPECT_FALSE(read_can_interface("nocan9")); }

TEST(CanStep, SaysWhatWasDeniedAndWhatToDo) {
  CanStep step{.kind = CanStepKind::kUp, .grant = Grant::kDenied, .error = ENETDOWN};
  step.interface = {'c', 'a', 'n', '0'};
  EXPECT_EQ(describe(step).why, "can0 is down");
  EXPECT_EQ(describe(step).remedy,
            "sudo ip link set can0 down && sudo ip link set can0 up type can bitrate 1000000 "
            "restart-ms 100");
  step = {.kind = CanStepKind::kFormat,
          .grant = Grant::kDenied,
          .error = EMSGSIZE,
          .interface = {'v', 'c', 'a', 'n', '0'},
          .format = CanFrame::Format::kFd};
  EXPECT_EQ(describe(step).remedy, "sudo ip link set vcan0 mtu 72 up");
  step.kind = CanStepKind::kInterface;
  step.error = ENODEV;
  EXPECT_EQ(describe(step).why, "there is no interface vcan0");
  step.grant = Grant::kGranted;
  EXPECT_EQ(describe(step).why, "vcan0 is open");
}

}  // namespace
}  // namespace plumb::drivers
