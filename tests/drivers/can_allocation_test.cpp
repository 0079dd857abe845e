// SPDX-License-Identifier: Apache-2.0
// No allocation in a cycle on the bus: every heap call of this program is counted.
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include <memory>

#include "plumb/drivers/can_port.hpp"
#include "tests/drivers/socket_pair.hpp"
#include "tests/heap_calls.hpp"

namespace plumb::drivers {
namespace {

using tests::heap_calls_of;

TEST(CanAllocation, IsCaughtWhenPlanted) {
  EXPECT_EQ(2, heap_calls_of([] {
              const auto planted = std::make_unique<double>(1.0);
              EXPECT_EQ(*planted, 1.0);
            }));
}

class EveryFormat : public testing::TestWithParam<CanFrame::Format> {};
INSTANTIATE_TEST_SUITE_P(CanAllocation, EveryFormat,
                         testing::Values(CanFrame::Format::kClassic, CanFrame::Format::kFd),
                         [](const auto& one) {
                           return one.param == CanFrame::Format::kFd ? "Fd" : "Classic";
                         });

TEST_P(EveryFormat, NeverHappensInACycle) {
  BusLayout layout = default_layout(6, 0.001);
  layout.can_format = GetParam();
  tests::SocketPair sockets;
  CanPort plumb(CanLink(sockets.link_end(), can_link_options(layout)), layout, Sender::kPlumb);
  CanPort controller(CanLink(sockets.release(), can_link_options(layout)), layout,
                     Sender::kController);
  BusMessage message;
  std::uint64_t heard = 0;
  EXPECT_EQ(0, heap_calls_of([&] {
              for (std::uint16_t i = 0; i < 1000; ++i) {
                controller.send({.kind = MessageKind::kTarget, .size = 6, .counter = i});
                while (plumb.receive(message)) ++heard;
                plumb.send({.kind = MessageKind::kCorrected, .size = 6, .counter = i});
                while (controller.receive(message)) ++heard;
              }
            }));
  EXPECT_EQ(heard, 2000U);
}

TEST(CanAllocation, NeverHappensWhenThingsGoWrong) {
  BusLayout layout = default_layout(6, 0.001);
  tests::SocketPair sockets(SOCK_DGRAM);
  CanPort plumb(CanLink(sockets.link_end(), can_link_options(layout)), layout, Sender::kPlumb);
  const can_frame frames[] = {
      tests::classic(CAN_ERR_FLAG | CAN_ERR_BUSOFF, {0, 0, 0, 0, 0, 0, 0, 0}),
      tests::classic(CAN_ERR_FLAG | CAN_ERR_CRTL, {0, 4, 0, 0, 0, 0, 0, 0}),
      tests::classic(0x118, {1, 2, 3}), tests::classic(0x130, {}),
      tests::classic(0x118 | CAN_RTR_FLAG, {})};
  BusMessage message;
  EXPECT_EQ(0, heap_calls_of([&] {
              for (int i = 0; i < 100; ++i)
                for (const auto& frame : frames) {
                  sockets.put(frame);
                  plumb.receive(message);
                  plumb.send({.kind = MessageKind::kStatus, .size = 7});
                }
              sockets.hang_up();
              plumb.receive(message);
              plumb.send({.kind = MessageKind::kStatus, .size = 7});
            }));
  EXPECT_EQ(plumb.counters().corrupt, 100U);
  EXPECT_EQ(plumb.counters().foreign_senders, 100U);
}

}  // namespace
}  // namespace plumb::drivers
