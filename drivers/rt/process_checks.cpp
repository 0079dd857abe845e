// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <sstream>

#include "plumb/drivers/rt_process.hpp"
#include "rt/check.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr auto kUnlimited = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kPriority = RtRequest{}.priority;

/// The soft limit; empty if the file does not state it. "unlimited" is the largest number.
std::optional<std::uint64_t> soft_limit(const MachineFiles& files, const std::string& name) {
  std::istringstream line(files.line("proc/self/limits", name).value_or(""));
  std::string word;
  line >> word;
  if (word == "unlimited") return kUnlimited;
  std::uint64_t out = 0;
  const auto end = std::from_chars(word.data(), word.data() + word.size(), out);
  return word.empty() || end.ec != std::errc() ? std::nullopt : std::optional(out);
}

std::string in_words(std::uint64_t limit, RtStepKind kind) {
  if (limit == kUnlimited) return "unlimited";
  return kind == RtStepKind::kMemoryLocked ? fmt::format("{} kB", limit / 1024)
                                           : std::to_string(limit);
}

/// A limit that is too low does no harm if the step itself was granted, for example to root.
Check limit_check(Check out, const Check& step, RtStepKind kind, std::optional<std::uint64_t> limit,
                  std::uint64_t wanted) {
  out.finding.why = limit ? in_words(*limit, kind) : "not shown";
  if (!limit) return out;
  const bool enough = *limit >= wanted;
  const bool privileged = step.finding.grant == Grant::kGranted;
  out.finding.grant = enough || privileged ? Grant::kGranted : Grant::kDenied;
  if (enough) return out;
  out.finding.why += privileged ? ", yet what it limits was granted" : ": too little";
  if (!privileged) out.finding.remedy = describe({.kind = kind, .grant = Grant::kDenied}).remedy;
  return out;
}

}  // namespace

std::vector<Check> process_checks(const MachineFiles& files, std::span<const RtStep> steps) {
  const Check fifo = step_check("sched_fifo", Need::kAlways, steps, RtStepKind::kPriority);
  const Check lock = step_check("mlockall", Need::kAlways, steps, RtStepKind::kMemoryLocked);
  Check priority{.id = "rlimit_rtprio", .finding = {.what = "RLIMIT_RTPRIO"}};
  priority = limit_check(priority, fifo, RtStepKind::kPriority,
                         soft_limit(files, "Max realtime priority"), kPriority);
  Check memory{.id = "rlimit_memlock", .finding = {.what = "RLIMIT_MEMLOCK"}};
  memory = limit_check(memory, lock, RtStepKind::kMemoryLocked,
                       soft_limit(files, "Max locked memory"), kUnlimited);
  return {fifo, priority, lock, memory};
}

}  // namespace plumb::drivers::rt
