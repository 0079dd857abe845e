// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/rt_step.hpp"

#include <cerrno>
#include <cstring>

namespace plumb::drivers {
namespace {

constexpr char kLimitsFile[] = "/etc/security/limits.d/plumb.conf";

/// The command that adds a line for the present user to the limits of the system. It takes effect
/// at the next login.
std::string raise_limit(const char* item) {
  return std::string("echo \"$USER - ") + item + "\" | sudo tee -a " + kLimitsFile;
}

std::string name(const RtStep& step) {
  switch (step.kind) {
    case RtStepKind::kHeapKept:
      return "heap kept";
    case RtStepKind::kMemoryLocked:
      return "memory lock";
    case RtStepKind::kHeapTouched:
      return "heap touched";
    case RtStepKind::kStackTouched:
      return "stack touched";
    case RtStepKind::kTimerSlack:
      return "timer slack";
    case RtStepKind::kAffinity:
      return "processors";
    case RtStepKind::kIdleStates:
      return "idle states";
    case RtStepKind::kPriority:
      return "priority";
  }
  return "step";
}

std::string kilobytes(std::int64_t bytes) {
  return bytes < 0 ? "unlimited" : std::to_string(bytes / 1024) + " kB";
}

/// The requested setting, named by the system call that requests it.
std::string asked(const RtStep& step) {
  switch (step.kind) {
    case RtStepKind::kHeapKept:
      return "mallopt(M_TRIM_THRESHOLD, M_MMAP_MAX)";
    case RtStepKind::kMemoryLocked:
      return "mlockall(MCL_CURRENT | MCL_FUTURE)";
    case RtStepKind::kHeapTouched:
    case RtStepKind::kStackTouched:
      return kilobytes(step.asked);
    case RtStepKind::kTimerSlack:
      return std::to_string(step.asked) + " ns";
    case RtStepKind::kAffinity:
      return "sched_setaffinity to " + std::to_string(step.asked) + " processors";
    case RtStepKind::kIdleStates:
      return "at most " + std::to_string(step.asked) + " us to wake up";
    case RtStepKind::kPriority:
      return "SCHED_FIFO " + std::to_string(step.asked);
  }
  return "";
}

std::string limit(const RtStep& step) {
  switch (step.kind) {
    case RtStepKind::kMemoryLocked:
      return "; RLIMIT_MEMLOCK is " + kilobytes(step.limit);
    case RtStepKind::kHeapTouched:
      return "; RLIMIT_DATA is " + kilobytes(step.limit);
    case RtStepKind::kStackTouched:
      return "; RLIMIT_STACK is " + kilobytes(step.limit);
    case RtStepKind::kPriority:
      return "; RLIMIT_RTPRIO is " + std::to_string(step.limit);
    default:
      return "";
  }
}

std::string remedy(const RtStep& step) {
  switch (step.kind) {
    case RtStepKind::kMemoryLocked:
      return raise_limit("memlock unlimited");
    case RtStepKind::kHeapTouched:
      return "free -h";
    case RtStepKind::kStackTouched:
      return "ulimit -s 8192";
    case RtStepKind::kAffinity:
      return "cat /sys/devices/system/cpu/online";
    case RtStepKind::kIdleStates:
      return "sudo chmod o+w /dev/cpu_dma_latency";
    case RtStepKind::kPriority:
      return step.error == EINVAL ? "chrt --max" : raise_limit("rtprio 99");
    default:
      return "";
  }
}

}  // namespace

const char* to_string(Grant grant) noexcept {
  switch (grant) {
    case Grant::kGranted:
      return "granted";
    case Grant::kDenied:
      return "denied";
    case Grant::kSkipped:
      return "skipped";
  }
  return "skipped";
}

Finding describe(const RtStep& step) {
  Finding out{.what = name(step), .grant = step.grant, .why = "not asked for", .remedy = ""};
  if (step.grant == Grant::kSkipped) return out;
  out.why = asked(step);
  if (step.grant == Grant::kGranted) return out;
  out.why += std::string(": ") + std::strerror(step.error) + limit(step);
  out.remedy = remedy(step);
  return out;
}

}  // namespace plumb::drivers
