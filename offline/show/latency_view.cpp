// SPDX-License-Identifier: Apache-2.0
#include "show/latency_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "bench/cache_sweep.hpp"
#include "draw/duration.hpp"
#include "show/cost_view.hpp"
#include "show/table.hpp"

namespace plumb::offline::show {
namespace {

using bench::Benchmark;
using bench::Part;
using bench::Timing;
using bench::Timings;
using bench::Way;
using draw::duration;

const char* name_of(Way way) {
  if (way == Way::kWarm) return "warm";
  return way == Way::kChain ? "latency_chain" : "cold";
}

bool is_addition(Part part) { return part == Part::kEffect || part == Part::kTrees; }

Json kernel_json(const Timing& timing, const Timings& all) {
  Json out{{"name", name_of(timing.part)}};
  if (!timing.label.empty()) out["name"] = fmt::format("{}:{}", name_of(timing.part), timing.label);
  out["way"] = name_of(timing.way);
  put(out, "ns_median", timing.median());
  put(out, "ns_p99", timing.p99());
  put(out, "ns_max", timing.most());
  if (is_addition(timing.part)) put(out, "ns_median_added", all.added(timing));
  out["calls"] = timing.calls();
  out["calls_per_reading"] = timing.calls_per_reading;
  return out;
}

void put_text(Json& object, const std::string& key, const std::string& text) {
  if (text.empty())
    put_null(object, key, "this machine does not say");
  else
    object[key] = text;
}

Json conditions_json(const Benchmark& found) {
  const bench::Machine& machine = found.machine;
  Json out;
  put_text(out, "kernel", machine.kernel);
  out["preempt_rt"] = machine.preempt_rt;
  put_text(out, "cpu", machine.cpu);
  out["cpus"] = machine.cpus;
  put_text(out, "runs_on_cpus", bench::cpu_list(machine.allowed));
  out["isolated_cpus"] = bench::cpu_list(machine.isolated);
  out["sibling_cpus"] = bench::cpu_list(machine.siblings);
  put_text(out, "governor", fmt::format("{}", fmt::join(machine.governors, ",")));
  if (machine.virtual_machine)
    out["virtual_machine"] = *machine.virtual_machine;
  else
    put_null(out, "virtual_machine", "this machine does not say");
  put(out, "load_average_1min", machine.load.value_or(NAN), "this machine does not say");
  out["build"] = found.build.instructions;
  out["compiler"] = found.build.compiler;
  out["optimised"] = found.build.optimised;
  put(out, "clock_ns", found.timings.clock_ns);
  out["swept_bytes"] = bench::CacheSweep::kBytes;
  out["why_not_representative"] = found.why_not_representative;
  return out;
}

/// "0.06", "12", "130".
std::string cycle_percent(double share) {
  return share < 0.1 ? fmt::format("{:.2g}", 100.0 * share) : fmt::format("{:.0f}", 100.0 * share);
}

std::string cycle_share(const Benchmark& found) {
  return fmt::format("{} % of the {:g} ms cycle",
                     cycle_percent(1e-9 * found.cycle().median() / found.cycle_s),
                     1e3 * found.cycle_s);
}

std::string verdict(const Benchmark& found) {
  const Timing& cycle = found.cycle();
  return fmt::format("whole step: {} median, {}{}.\n", duration(cycle.median()), cycle_share(found),
                     found.why_not_representative.empty()
                         ? ""
                         : ", on a machine that is not fit to judge a controller by");
}

std::string calls_text(const Benchmark& found) {
  const Timing& cycle = found.cycle();
  return fmt::format(
      "Of {} calls, one by one: 99 % within {}, worst {}; allocations: {}; {} of {} random poses "
      "refused (seed {}).\n",
      cycle.calls(), duration(cycle.p99()), duration(cycle.most()), found.timings.allocations,
      found.refused_poses, found.poses, found.seed);
}

std::string row_name(const Timing& timing) {
  switch (timing.part) {
    case Part::kCycle:
      return "whole step";
    case Part::kKinematics:
      return "  kinematics alone";
    case Part::kEffect:
      return "  + " + timing.label;
    case Part::kTrees:
      return "  + trees";
    default:
      return name_of(timing.part);
  }
}

std::string ns_text(double ns) { return fmt::format("{:.0f}", ns); }

/// The medians warm, chained and cold; for an effect or the trees, what they add to the kinematics.
std::vector<std::string> row(const Timings& all, std::size_t kernel) {
  const std::size_t kernels = all.all.size() / 3;
  const Timing &warm = all.all[kernel], &chain = all.all[kernels + kernel],
               &cold = all.all[2 * kernels + kernel];
  if (is_addition(warm.part))
    return {row_name(warm), fmt::format("{:+.0f}", all.added(warm)),
            fmt::format("{:+.0f}", all.added(chain)), fmt::format("{:+.0f}", all.added(cold))};
  return {row_name(warm),         ns_text(warm.median()), ns_text(chain.median()),
          ns_text(cold.median()), ns_text(cold.p99()),    ns_text(cold.most())};
}

std::string conditions_text(const Benchmark& found) {
  const bench::Machine& machine = found.machine;
  const auto known = [](const std::string& text) {
    return text.empty() ? std::string("not known") : text;
  };
  return fmt::format(
      "Kernel {}{}; {}; governor {}; isolated CPUs: {}; built for {} by {}.\n"
      "warm: back to back. chain: each call waits for the one before. cold: one call after {} MiB "
      "were swept.\n+ over the kinematics alone: an effect with what all effects share, frames and "
      "loads.\nThe clock's own {:.0f} ns are taken off every reading.\n",
      known(machine.kernel), machine.preempt_rt ? " (PREEMPT_RT)" : ", not PREEMPT_RT",
      known(machine.cpu), known(fmt::format("{}", fmt::join(machine.governors, ", "))),
      machine.isolated.empty() ? "none" : bench::cpu_list(machine.isolated),
      found.build.instructions, found.build.compiler, bench::CacheSweep::kBytes >> 20,
      found.timings.clock_ns);
}

}  // namespace

Json bench_json(const Benchmark& found) {
  const Timing& cycle = found.cycle();
  Json out;
  put(out, "ns_median", cycle.median());
  put(out, "ns_p99", cycle.p99());
  put(out, "ns_max", cycle.most());
  out["calls"] = cycle.calls();
  out["allocations"] = found.timings.allocations;
  put(out, "instructions", std::round(found.instructions));
  put(out, "instructions_baseline", std::round(found.baseline));
  out["representative"] = found.why_not_representative.empty();
  out["conditions"] = conditions_json(found);
  out["cycle_us"] = 1e6 * found.cycle_s;
  out["share_of_cycle_pct"] = 1e-7 * cycle.median() / found.cycle_s;
  out["seed"] = found.seed;
  out["poses"] = found.poses;
  out["refused_poses"] = found.refused_poses;
  out["kernels"] = Json::array();
  for (const Timing& timing : found.timings.all)
    out["kernels"].push_back(kernel_json(timing, found.timings));
  return out;
}

std::string bench_text(const Benchmark& found) {
  Table table{.head = {"[ns] median", "warm", "chain", "cold", "cold 99 %", "cold worst"}};
  for (std::size_t i = 0; i < found.timings.all.size() / 3; ++i) table.add(row(found.timings, i));
  return verdict(found) + bench::fitness_text(found.why_not_representative) + "\n" +
         instructions_text(found.instructions, found.baseline) + calls_text(found) + "\n" +
         text_of(table) + "\n" + conditions_text(found);
}

}  // namespace plumb::offline::show
