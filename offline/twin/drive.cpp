// SPDX-License-Identifier: Apache-2.0
#include "twin/drive.hpp"

#include <cmath>

#include "plumb/drivers/cycle_clock.hpp"

namespace plumb::offline::twin {
namespace {

constexpr std::uint64_t kTendEvery = 64;  // cycles
constexpr int kAfterwards = 8;  // cycles at the end, so that no message in transit is lost

}  // namespace

std::vector<Stop> drive_uncorrected(const Cell& cell, const Path& path,
                                    const ControllerSettings& settings) {
  TwinTime time;
  const FaultPlan no_faults;
  Controller controller(cell, path, settings, Controller::Corrections::kIgnore, {}, no_faults,
                        time);
  const auto cycle_ns = static_cast<std::int64_t>(std::llround(settings.cycle_s * 1e9));
  for (std::int64_t now_ns = cycle_ns; !controller.done(); now_ns += cycle_ns)
    controller.cycle(now_ns, nullptr);
  return controller.stops();
}

std::uint64_t drive_in_real_time(Controller& controller, Link& link, double cycle_s,
                                 double longest_s, const std::function<bool()>& stop) {
  drivers::CycleClock<> clock(std::llround(cycle_s * 1e9));
  const std::int64_t begin_ns = drivers::MonotonicTime::now_ns();
  std::uint64_t cycles = 0;
  for (int left = kAfterwards; left > 0 && !stop();) {
    const drivers::Tick tick = clock.wait();
    if (tick.error != 0) break;
    if (longest_s > 0.0 && 1e-9 * static_cast<double>(tick.time_ns - begin_ns) > longest_s) break;
    controller.cycle(tick.time_ns, &link.port());
    if (++cycles % kTendEvery == 0) link.tend();
    if (controller.done()) --left;
  }
  return clock.counters().missed;
}

}  // namespace plumb::offline::twin
