// SPDX-License-Identifier: Apache-2.0
// No heap, no lock, no system call but those of the clock on the thread of the real loop, with a
// Modbus link attached: what speaks to the network is the link's own thread.
#include <gtest/gtest.h>

#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_port.hpp"
#include "plumb/drivers/modbus_server.hpp"
#include "tests/drivers/linked_loop.hpp"
#include "tests/drivers/watched_locks.hpp"

namespace plumb::tests {
namespace {

/// One end is the server, the other the client.
bool run_on_modbus(Sender at_server, const Watched& how, WatchedCalls& calls) {
  const BusLayout layout = default_layout(6, 1e-9 * static_cast<double>(kBeat_ns));
  const Sender at_client = at_server == Sender::kPlumb ? Sender::kController : Sender::kPlumb;
  ModbusServer server(
      layout, {.at = TcpAddress{"127.0.0.1", 0}, .peers = {"127.0.0.1"}, .self = at_server});
  if (server.start()) std::abort();
  ModbusClient client(layout,
                      {.server = TcpAddress{"127.0.0.1", server.port()}, .self = at_client});
  if (client.start()) std::abort();
  ModbusPort of_server(server.exchange(), layout, at_server);
  ModbusPort of_client(client.exchange(), layout, at_client);
  const bool plumb_serves = at_server == Sender::kPlumb;
  return run_linked_loop(plumb_serves ? of_server : of_client, plumb_serves ? of_client : of_server,
                         how, calls);
}

class LoopOnModbus : public testing::TestWithParam<Sender> {};
INSTANTIATE_TEST_SUITE_P(Calls, LoopOnModbus, testing::Values(Sender::kController, Sender::kPlumb),
                         [](const auto& one) {
                           return one.param == Sender::kPlumb ? "AsServer" : "AsClient";
                         });

TEST_P(LoopOnModbus, NeverAllocatesLocksOrAsksTheSystemForMoreThanTime) {
  const Watched how{.allowed = kClockCalls};
  WatchedCalls* calls = nullptr;
  const Ended ended =
      run_watched(calls, [&](WatchedCalls& seen) { return run_on_modbus(GetParam(), how, seen); });
  if (ended == Ended::kNoFilter) GTEST_SKIP() << kNoFilterHere;
  ASSERT_EQ(ended, Ended::kWell);
  expect_clean(*calls, how);
}

}  // namespace
}  // namespace plumb::tests
