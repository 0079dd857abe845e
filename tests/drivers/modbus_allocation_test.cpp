// SPDX-License-Identifier: Apache-2.0
// No allocation while a Modbus link runs, on the cycle's thread or the link's own: every heap call
// of this program is counted.
#include <gtest/gtest.h>

#include <memory>

#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_port.hpp"
#include "plumb/drivers/modbus_server.hpp"
#include "tests/drivers/modbus_support.hpp"
#include "tests/heap_calls.hpp"

namespace plumb::drivers {
namespace {

using tests::heap_calls;

static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "a mailbox has no lock");

TEST(ModbusAllocation, IsCaughtWhenPlanted) {
  const long before = heap_calls;
  const auto planted = std::make_unique<double>(1.0);
  EXPECT_EQ(*planted, 1.0);
  EXPECT_EQ(heap_calls - before, 1);
}

TEST(ModbusAllocation, NeverHappensOnceALinkRuns) {
  const BusLayout layout = default_layout(6, 0.001);
  ModbusServer server(
      layout,
      {.at = TcpAddress{"127.0.0.1", 0}, .peers = {"127.0.0.1"}, .self = Sender::kController});
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
  const long before = heap_calls;
  ASSERT_TRUE(talk_until(1200));
  EXPECT_LE(heap_calls - before, 2) << "but the two of soon() itself";
}

}  // namespace
}  // namespace plumb::drivers
