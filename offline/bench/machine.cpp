// SPDX-License-Identifier: Apache-2.0
#include "bench/machine.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

namespace plumb::offline::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kRest = 0.25;  // load average a CPU: below, little else runs

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string out;
  std::getline(in, out);
  return out;
}

/// "model name : AMD EPYC": what stands behind the colon on the first line that begins so.
std::string value_of(const fs::path& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    const auto begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "";
}

std::optional<double> number(const std::string& text) {
  std::istringstream in(text);
  double out = 0.0;
  if (in >> out) return out;
  return std::nullopt;
}

CpuSet allowed_cpus() {
  CpuSet out;
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return out;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &set)) out.insert(cpu);
  return out;
}

/// Only x86 shows a virtual machine by a CPU flag; elsewhere the device tree does, if there is one.
std::optional<bool> virtual_machine(const fs::path& root) {
  if (fs::exists(root / "sys/hypervisor/type") || fs::exists(root / "proc/device-tree/hypervisor"))
    return true;
  const std::string flags = " " + value_of(root / "proc/cpuinfo", "flags") + " ";
  if (flags == "  ") return std::nullopt;
  return flags.find(" hypervisor ") != std::string::npos;
}

bool is_preempt_rt(const fs::path& root) {
  return first_line(root / "sys/kernel/realtime") == "1" ||
         first_line(root / "proc/version").find("PREEMPT_RT") != std::string::npos;
}

/// Linux version 6.1.0-31-rt-amd64 (...): its third word.
std::string kernel_release(const fs::path& root) {
  std::istringstream in(first_line(root / "proc/version"));
  std::string word;
  in >> word >> word >> word;
  return word;
}

void look_at_cores(const fs::path& root, Machine& out) {
  const fs::path cpus = root / "sys/devices/system/cpu";
  for (const int cpu : out.allowed) {
    const fs::path one = cpus / ("cpu" + std::to_string(cpu));
    const std::string governor = first_line(one / "cpufreq/scaling_governor");
    if (!governor.empty()) out.governors.insert(governor);
    CpuSet sharing = parse_cpus(first_line(one / "topology/thread_siblings_list"));
    sharing.erase(cpu);
    out.siblings.merge(sharing);
  }
}

bool runs_isolated(const Machine& machine) {
  return !machine.allowed.empty() && std::includes(machine.isolated.begin(), machine.isolated.end(),
                                                   machine.allowed.begin(), machine.allowed.end());
}

std::string decimal(double value) {
  std::ostringstream out;
  out.precision(2);
  out << std::fixed << value;
  return out.str();
}

std::string about_cores(const Machine& machine) {
  if (machine.isolated.empty()) return "no isolated CPU";
  return "runs on CPU " + cpu_list(machine.allowed) + ", isolated is " + cpu_list(machine.isolated);
}

std::string about_governor(const Machine& machine) {
  if (machine.governors.empty()) return "no CPU governor to be seen";
  std::string out = "CPU governor";
  for (const auto& governor : machine.governors) out += " " + governor;
  return out;
}

}  // namespace

CpuSet parse_cpus(const std::string& list) {
  CpuSet out;
  std::istringstream in(list);
  for (std::string part; std::getline(in, part, ',');) {
    const char* const end = part.data() + part.size();
    int first = 0;
    const auto read = std::from_chars(part.data(), end, first);
    if (read.ec != std::errc()) continue;
    int last = first;
    if (read.ptr != end && *read.ptr == '-') std::from_chars(read.ptr + 1, end, last);
    for (int cpu = first; cpu <= std::min(last, first + CPU_SETSIZE); ++cpu) out.insert(cpu);
  }
  return out;
}

std::string cpu_list(const CpuSet& cpus) {
  std::string out;
  for (auto it = cpus.begin(); it != cpus.end();) {
    const int first = *it;
    int last = first;
    while (++it != cpus.end() && *it == last + 1) last = *it;
    out += (out.empty() ? "" : ",") + std::to_string(first);
    if (last > first) out += "-" + std::to_string(last);
  }
  return out;
}

Machine look_at_machine(const fs::path& root) {
  const fs::path cpus = root / "sys/devices/system/cpu";
  Machine out;
  out.kernel = kernel_release(root);
  out.preempt_rt = is_preempt_rt(root);
  out.cpu = value_of(root / "proc/cpuinfo", "model name");
  out.cpus = static_cast<int>(parse_cpus(first_line(cpus / "online")).size());
  out.allowed = allowed_cpus();
  out.isolated = parse_cpus(first_line(cpus / "isolated"));
  out.virtual_machine = virtual_machine(root);
  out.load = number(first_line(root / "proc/loadavg"));
  look_at_cores(root, out);
  return out;
}

std::vector<std::string> why_not_representative(const Machine& machine, const Build& build) {
  std::vector<std::string> out;
  if (!build.optimised) out.push_back("this build is not optimised");
  if (!machine.virtual_machine)
    out.push_back("it cannot be told whether this is a virtual machine");
  if (machine.virtual_machine.value_or(false)) out.push_back("virtual machine");
  if (!runs_isolated(machine)) out.push_back(about_cores(machine));
  if (machine.governors != std::set<std::string>{"performance"})
    out.push_back(about_governor(machine));
  if (!machine.siblings.empty())
    out.push_back("the core is shared with CPU " + cpu_list(machine.siblings));
  if (!machine.load)
    out.push_back("the load is not known");
  else if (!(*machine.load <= kRest * std::max(1, machine.cpus)))
    out.push_back("load average " + decimal(*machine.load) + " on " + std::to_string(machine.cpus) +
                  " CPUs");
  return out;
}

std::string fitness_text(const std::vector<std::string>& why_not) {
  if (why_not.empty())
    return "Representative: bare metal, an isolated core at full clock, little else running.";
  return fmt::format(
      "Not representative: {}. These are wall-clock times of this machine now, no latency of a "
      "controller.",
      fmt::join(why_not, "; "));
}

}  // namespace plumb::offline::bench
