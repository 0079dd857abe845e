// SPDX-License-Identifier: Apache-2.0
#include "bench/step_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "bench/machine.hpp"
#include "bench/step_instructions.hpp"
#include "bench/whole_cycle.hpp"

namespace plumb::offline::bench {
namespace {

constexpr std::size_t kSteps = 2000;  // enough for a 99 % quantile, in less than a second

}  // namespace

StepCost step_cost(const format::Model& model) {
  using Clock = std::chrono::steady_clock;
  const BenchInputs inputs(model, 1);
  WholeCycle cycle(model);
  double kept = 0.0;
  std::vector<double> us;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const auto begin = Clock::now();
    kept += cycle.step(inputs.pose(i), inputs.context(i)).X_BC.p(0);
    us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  std::sort(us.begin(), us.end());
  const Build build = this_build();
  const Machine machine = look_at_machine();
  return {.instructions = step_instructions(model),
          .baseline = baseline_instructions(model),
          .median_us = us[kSteps / 2],
          .worst_us = us[kSteps - kSteps / 100],
          .cpu = machine.cpu,
          .build = build.instructions,
          .optimised = build.optimised && kept == kept,
          .why_not_representative = why_not_representative(machine, build)};
}

std::string cycle_fault(const StepCost& cost, double cycle_s) {
  const double cycle_us = 1e6 * cycle_s;
  if (!cost.optimised || cost.worst_us <= kMostOfCycle * cycle_us) return "";
  return fmt::format("a step takes {:.0f} us on {}, more than {:.0f} % of the cycle of {:.0f} us",
                     cost.worst_us, cost.cpu.empty() ? "this machine" : cost.cpu,
                     100.0 * kMostOfCycle, cycle_us);
}

}  // namespace plumb::offline::bench
