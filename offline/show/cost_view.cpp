// SPDX-License-Identifier: Apache-2.0
#include "show/cost_view.hpp"

#include <fmt/format.h>

namespace plumb::offline::show {

Json cost_json(const bench::StepCost& cost) {
  Json out;
  put(out, "step_us", cost.median_us);
  put(out, "step_p99_us", cost.p99_us);
  if (cost.instructions)
    put(out, "instructions", *cost.instructions);
  else
    put_null(out, "instructions", "this machine does not count instructions");
  out["cpu"] = cost.cpu;
  out["build"] = cost.build;
  return out;
}

std::string cost_text(const bench::StepCost& cost) {
  const std::string count =
      cost.instructions ? fmt::format("{:.0f} instructions, ", *cost.instructions) : "";
  return fmt::format("A step of the cycle: {}{:.1f} us (99 % within {:.1f} us) on {}, {}.\n", count,
                     cost.median_us, cost.p99_us, cost.cpu.empty() ? "this machine" : cost.cpu,
                     cost.build);
}

}  // namespace plumb::offline::show
