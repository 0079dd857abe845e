// SPDX-License-Identifier: Apache-2.0
// Asks for a real-time process and opens a CAN interface that does not exist.
#include <cstdio>
#include <plumb/drivers/can_interface.hpp>
#include <plumb/drivers/latency_histogram.hpp>
#include <plumb/drivers/modbus_client.hpp>
#include <plumb/drivers/rt_process.hpp>

int main() {
  const plumb::drivers::RtProcess process({.lock = plumb::drivers::RtRequest::Lock::kNone});
  plumb::drivers::LatencyHistogram wake;
  wake.add(12'000);
  std::printf("%zu steps, worst %lld ns\n", process.steps().size(),
              static_cast<long long>(wake.worst_ns()));
  return wake.count() == 1 ? 0 : 1;
}
