// SPDX-License-Identifier: Apache-2.0
#include "show/cost_view.hpp"

#include <fmt/format.h>

#include <cmath>

namespace plumb::offline::show {

Json cost_json(const bench::StepCost& cost) {
  Json out;
  put(out, "instructions", std::round(cost.instructions));
  put(out, "step_us", cost.median_us);
  put(out, "worst_us", cost.worst_us);
  out["cpu"] = cost.cpu;
  out["build"] = cost.build;
  return out;
}

std::string cost_text(const bench::StepCost& cost) {
  return fmt::format(
      "A step of the cycle takes at worst about {:.1f} thousand instructions (counted for "
      "x86-64-v3). On {} ({}) 99 % of the steps took less than {:.1f} us, half of them less than "
      "{:.1f} us.\n",
      1e-3 * cost.instructions, cost.cpu.empty() ? "this machine" : cost.cpu, cost.build,
      cost.worst_us, cost.median_us);
}

}  // namespace plumb::offline::show
