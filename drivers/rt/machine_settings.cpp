// SPDX-License-Identifier: Apache-2.0
#include "rt/machine_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace plumb::drivers::rt {
namespace {

constexpr const char* kWrittenBy = "# Written by plumb-rt doctor --fix.\n";
constexpr const char* kReviewed = "/etc/default/grub.d/90-plumb.cfg";

MachineSetting sysctl() {
  return {.file = "etc/sysctl.d/90-plumb.conf",
          .text = std::string(kWrittenBy) +
                  "# A real-time thread is not stopped for a part of every second.\n"
                  "kernel.sched_rt_runtime_us = -1\n",
          .then = "sudo sysctl --system"};
}

MachineSetting limits() {
  return {.file = "etc/security/limits.d/90-plumb.conf",
          .text = std::string(kWrittenBy) +
                  "# Who is in the group plumb may run plumb-rt by hand in real time; the service "
                  "has these\n# rights from its unit.\n"
                  "@plumb - rtprio 90\n@plumb - memlock unlimited\n",
          .then = "sudo adduser USER plumb, and a new login"};
}

MachineSetting at_every_boot() {
  return {.file = "etc/tmpfiles.d/90-plumb.conf",
          .text = std::string(kWrittenBy) +
                  "# Set at every boot: pages are not moved in the background, and the clock "
                  "frequency stays.\n"
                  "w- /sys/kernel/mm/transparent_hugepage/enabled - - - - madvise\n"
                  "w- /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor - - - - performance\n",
          .then = "sudo systemd-tmpfiles --create 90-plumb.conf"};
}

/// The last processor that is the first of its core, which hyper-threading that is off leaves; 0 if
/// there is no second core.
int processor_for_the_cycle(const MachineFiles& files) {
  const std::string folder = "sys/devices/system/cpu/";
  int last = 0;
  for (const auto& name : files.names(folder)) {
    if (!name.starts_with("cpu") || name.size() < 4 || name.size() > 7) continue;
    if (!std::all_of(name.begin() + 3, name.end(), [](unsigned char c) { return std::isdigit(c); }))
      continue;
    const std::string number = name.substr(3);
    const auto core = files.read(folder + name + "/topology/thread_siblings_list").value_or(number);
    if (core.substr(0, core.find_first_of(",-")) == number)
      last = std::max(last, std::stoi(number));
  }
  return last;
}

MachineSetting isolation(const MachineFiles& files, int cpu) {
  const bool shared = files.read("sys/devices/system/cpu/smt/active") == "1";
  std::string text = kWrittenBy;
  text += fmt::format(
      "# Not active yet. Read it; then\n"
      "#   sudo mv {0}.review {0} && sudo update-grub && sudo reboot\n"
      "# and in [cycle] of rt.toml: cpu = {1}\n"
      "# Processor {1} runs the cycle and nothing else{2}.\n"
      "GRUB_CMDLINE_LINUX=\"$GRUB_CMDLINE_LINUX isolcpus=managed_irq,domain,{1} nohz_full={1} "
      "rcu_nocbs={1} irqaffinity=0{3}\"\n",
      kReviewed, cpu, shared ? "; nosmt: no core has two processors" : "", shared ? " nosmt" : "");
  return {
      .file = std::string(kReviewed).substr(1) + ".review",
      .text = text,
      .then = fmt::format("read it, then: sudo mv {0}.review {0} && sudo update-grub", kReviewed)};
}

}  // namespace

std::vector<MachineSetting> machine_settings(const MachineFiles& files) {
  std::vector<MachineSetting> out{sysctl(), limits(), at_every_boot()};
  if (const int cpu = processor_for_the_cycle(files); cpu > 0) out.push_back(isolation(files, cpu));
  return out;
}

std::vector<std::string> beyond_settings(const MachineFiles& files, std::span<const Check> checks) {
  std::vector<std::string> out;
  for (const Check& check : checks) {
    const bool ours = check.id == "kernel" || check.id == "machine" || check.id == "clocksource";
    if (!ours || check.finding.grant == Grant::kGranted) continue;
    out.push_back(fmt::format("{}: {}{}", check.finding.what, check.finding.why,
                              check.finding.remedy.empty() ? "" : "; " + check.finding.remedy));
  }
  if (processor_for_the_cycle(files) == 0)
    out.emplace_back("processors: there is one core only, which the cycle shares with all others");
  out.emplace_back(
      "firmware (BIOS, UEFI): idle states below C1, changing clock frequencies, hyper-threading "
      "and "
      "power saving of PCIe and USB belong off; no program can set that");
  return out;
}

}  // namespace plumb::drivers::rt
