// SPDX-License-Identifier: Apache-2.0
#include "show/cost_view.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bench/machine.hpp"

namespace plumb::offline::show {

Json cost_json(const bench::StepCost& cost) {
  Json out;
  put(out, "instructions", std::round(cost.instructions));
  put(out, "instructions_baseline", std::round(cost.baseline));
  put(out, "step_us", cost.median_us);
  put(out, "worst_us", cost.worst_us);
  out["cpu"] = cost.cpu;
  out["build"] = cost.build;
  out["representative"] = cost.why_not_representative.empty();
  out["why_not_representative"] = cost.why_not_representative;
  return out;
}

std::string instructions_text(double instructions, double baseline) {
  return fmt::format(
      "A step of the cycle takes at worst about {:.1f} thousand instructions in the build for "
      "x86-64-v3 (AVX2), {:.1f} thousand in the one for every x86-64.\n",
      1e-3 * instructions, 1e-3 * baseline);
}

std::string cost_text(const bench::StepCost& cost) {
  return instructions_text(cost.instructions, cost.baseline) +
         fmt::format(
             "On {} (built for {}) 99 % of the steps took less than {:.1f} us, half of them less "
             "than {:.1f} us. {}\n",
             cost.cpu.empty() ? "this machine" : cost.cpu, cost.build, cost.worst_us,
             cost.median_us, bench::fitness_text(cost.why_not_representative));
}

}  // namespace plumb::offline::show
