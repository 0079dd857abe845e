// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <set>

#include "rt/check.hpp"

namespace plumb::drivers::rt {
namespace {

const std::string kProcessors = "sys/devices/system/cpu/";

bool is_processor(const std::string& name) {
  return name.size() > 3 && name.starts_with("cpu") && std::isdigit(name[3]) != 0;
}

std::set<std::string> governors(const MachineFiles& files) {
  std::set<std::string> out;
  for (const auto& name : files.names(kProcessors)) {
    if (!is_processor(name)) continue;
    const auto governor = files.read(kProcessors + name + "/cpufreq/scaling_governor");
    if (governor) out.insert(*governor);
  }
  return out;
}

Check governor(const MachineFiles& files) {
  Check out{.id = "governor", .need = Need::kShortCycle, .finding = {.what = "CPU governor"}};
  std::set<std::string> found = governors(files);
  if (found.empty()) {
    out.finding.why = "no frequency control is shown";
    return out;
  }
  const bool fast = found == std::set<std::string>{"performance"};
  out.finding.why = fmt::format("{}{}", fmt::join(found, ", "),
                                fast ? "" : ": the clock frequency changes, and takes its time");
  out.finding.grant = fast ? Grant::kGranted : Grant::kDenied;
  if (!fast)
    out.finding.remedy =
        "echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor";
  return out;
}

Check isolated(const MachineFiles& files) {
  Check out{.id = "isolated", .need = Need::kShortCycle, .finding = {.what = "isolated CPUs"}};
  const std::string list = files.read(kProcessors + "isolated").value_or("");
  const std::string tickless = files.read(kProcessors + "nohz_full").value_or("");
  out.finding.grant = list.empty() ? Grant::kDenied : Grant::kGranted;
  out.finding.why =
      list.empty() ? "no CPU is isolated: the cycle shares its own with others" : list;
  const bool some = !tickless.empty() && tickless != "(null)";
  out.finding.why += some ? fmt::format("; nohz_full {}", tickless) : "; no nohz_full";
  if (list.empty())
    out.finding.remedy =
        "sudo sed -i 's/^GRUB_CMDLINE_LINUX=\"/&isolcpus=1 nohz_full=1 rcu_nocbs=1 /' "
        "/etc/default/grub && sudo update-grub";
  return out;
}

Check siblings(const MachineFiles& files) {
  Check out{.id = "hyper_threading", .need = Need::kShortCycle, .finding = {.what = "siblings"}};
  const auto active = files.read(kProcessors + "smt/active");
  if (!active) {
    out.finding.why = "not shown";
    return out;
  }
  const bool shared = *active == "1";
  const auto pair = files.read(kProcessors + "cpu0/topology/thread_siblings_list").value_or("?");
  out.finding.grant = shared ? Grant::kDenied : Grant::kGranted;
  out.finding.why = shared ? fmt::format("hyper-threading: CPUs {} share a core", pair)
                           : "every CPU has its own core";
  if (shared) out.finding.remedy = "echo off | sudo tee /sys/devices/system/cpu/smt/control";
  return out;
}

}  // namespace

std::vector<Check> processor_checks(const MachineFiles& files, std::span<const RtStep> steps) {
  return {governor(files),
          step_check("cpu_dma_latency", Need::kShortCycle, steps, RtStepKind::kIdleStates),
          isolated(files), siblings(files)};
}

}  // namespace plumb::drivers::rt
