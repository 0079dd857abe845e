// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "rt/check.hpp"

namespace plumb::drivers::rt {
namespace {

#if defined(__aarch64__)
constexpr const char* kDebianRtKernel = "sudo apt-get install linux-image-rt-arm64";
#else
constexpr const char* kDebianRtKernel = "sudo apt-get install linux-image-rt-amd64";
#endif

/// Clocks that a program reads without a system call.
constexpr std::array<std::string_view, 4> kFastClocks = {"tsc", "arch_sys_counter", "kvm-clock",
                                                         "hyperv_clocksource_tsc_page"};

Grant granted_if(bool good) { return good ? Grant::kGranted : Grant::kDenied; }

/// Linux version 6.1.0-56-rt-amd64 (...) ...: its third word.
std::string release(const std::string& version) {
  const auto begin = std::min(version.size(), std::string_view("Linux version ").size());
  return version.substr(begin, version.find(' ', begin) - begin);
}

Check kernel(const MachineFiles& files) {
  Check out{.id = "kernel", .need = Need::kAlways, .finding = {.what = "kernel"}};
  const auto version = files.read("proc/version");
  if (!version) {
    out.finding.why = "the kernel is not known: no /proc/version";
    return out;
  }
  const bool rt =
      version->find("PREEMPT_RT") != std::string::npos || files.read("sys/kernel/realtime") == "1";
  out.finding.grant = granted_if(rt);
  out.finding.why = fmt::format("{} is {}PREEMPT_RT", release(*version), rt ? "" : "not ");
  if (!rt) out.finding.remedy = kDebianRtKernel;
  return out;
}

/// Fails in a virtual machine: no check inside it can notice that the host suspends its processors.
Check virtual_machine(const MachineFiles& files) {
  Check out{.id = "machine", .need = Need::kAlways, .finding = {.what = "machine"}};
  if (!files.read("proc/cpuinfo")) {
    out.finding.why = "the machine is not known: no /proc/cpuinfo";
    return out;
  }
  const std::string flags = files.line("proc/cpuinfo", "flags").value_or("") + " ";
  const bool inside =
      flags.find("hypervisor ") != std::string::npos || files.read("sys/hypervisor/type");
  out.finding.grant = granted_if(!inside);
  out.finding.why = inside ? "this is a virtual machine: its host may take the processor away"
                           : "no hypervisor shows";
  return out;
}

Check clocksource(const MachineFiles& files) {
  const std::string folder = "sys/devices/system/clocksource/clocksource0/";
  Check out{.id = "clocksource", .need = Need::kShortCycle, .finding = {.what = "clock source"}};
  const auto now = files.read(folder + "current_clocksource");
  if (!now) {
    out.finding.why = "not shown";
    return out;
  }
  const bool fast = std::find(kFastClocks.begin(), kFastClocks.end(), *now) != kFastClocks.end();
  out.finding.grant = granted_if(fast);
  out.finding.why = *now + (fast ? "" : " as clock source: every reading is slow");
  if (!fast) out.finding.remedy = fmt::format("cat /{}available_clocksource", folder);
  return out;
}

Check throttling(const MachineFiles& files) {
  Check out{.id = "rt_throttling", .need = Need::kAdvice, .finding = {.what = "throttling"}};
  const auto runtime = files.read("proc/sys/kernel/sched_rt_runtime_us");
  if (!runtime) {
    out.finding.why = "not shown";
    return out;
  }
  const bool off = *runtime == "-1";
  const auto period = files.read("proc/sys/kernel/sched_rt_period_us").value_or("1000000");
  out.finding.grant = granted_if(off);
  out.finding.why =
      off ? "off" : fmt::format("real-time threads stop after {} of {} us", *runtime, period);
  if (!off) out.finding.remedy = "sudo sysctl -w kernel.sched_rt_runtime_us=-1";
  return out;
}

Check huge_pages(const MachineFiles& files) {
  Check out{.id = "huge_pages", .need = Need::kShortCycle, .finding = {.what = "huge pages"}};
  const auto choice = files.read("sys/kernel/mm/transparent_hugepage/enabled");
  if (!choice) {
    out.finding.why = "not built in";
    return out;
  }
  const bool always = choice->find("[always]") != std::string::npos;
  out.finding.grant = granted_if(!always);
  out.finding.why = always ? "huge pages are made in the background, which moves pages"
                           : "only for those who ask";
  if (always)
    out.finding.remedy = "echo madvise | sudo tee /sys/kernel/mm/transparent_hugepage/enabled";
  return out;
}

}  // namespace

std::vector<Check> kernel_checks(const MachineFiles& files) {
  return {kernel(files), virtual_machine(files), clocksource(files), throttling(files),
          huge_pages(files)};
}

}  // namespace plumb::drivers::rt
