// SPDX-License-Identifier: Apache-2.0
// No allocation while a Modbus link runs, on the cycle's thread or the link's own: every malloc of
// this program is counted, operator new included.
#include <gtest/gtest.h>

#include <memory>

#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_port.hpp"
#include "plumb/drivers/modbus_server.hpp"
#include "tests/drivers/counted_malloc.hpp"
#include "tests/drivers/modbus_support.hpp"

namespace plumb::drivers {
namespace {

using tests::allocations;

static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "a mailbox has no lock");

TEST(ModbusAllocation, IsCaughtWhenPlanted) {
  const long before = allocations;
  const auto planted = std::make_unique<double>(1.0);
  EXPECT_EQ(*planted, 1.0);
  EXPECT_EQ(allocations - before, 1);
}

TEST(ModbusAllocation, NeverHappensOnceALinkRuns) {
  const BusLayout layout = default_layout(6, 0.001);
  ModbusServer server(layout, {.at = TcpAddress{"127.0.0.1", 0}, .self = Sender::kController});
  ASSERT_FALSE(server.start());
  ModbusClient client(layout, {.server = TcpAddress{"127.0.0.1", server.port()}});
  ASSERT_FALSE(client.start());
  ModbusPort plumb(client.exchange(), layout, Sender::kPlumb);
  ModbusPort controller(server.exchange(), layout, Sender::kController);
  BusMessage target{.kind = MessageKind::kTarget, .size = 6};
  BusMessage corrected{.kind = MessageKind::kCorrected, .size = 6};
  BusMessage heard;
  int count = 0;
  const auto talk_until = [&](int goal) {
    return tests::soon([&] {
      ++target.counter;
      ++corrected.counter;
      controller.send(target);
      plumb.send(corrected);
      while (plumb.receive(heard)) ++count;
      while (controller.receive(heard)) ++count;
      return count >= goal;
    });
  };
  ASSERT_TRUE(talk_until(200));
  const long before = allocations;
  ASSERT_TRUE(talk_until(1200));
  EXPECT_LE(allocations - before, 1) << "but that of soon() itself";
}

}  // namespace
}  // namespace plumb::drivers
