// SPDX-License-Identifier: Apache-2.0
#include "bench/step_cost.hpp"

#include <fmt/format.h>

#ifdef __linux__
#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <chrono>
#include <vector>

#include "bench/machine.hpp"
#include "bench/whole_cycle.hpp"

namespace plumb::offline::bench {
namespace {

constexpr std::size_t kSteps = 2000;

/// Counts the instructions of this thread in user mode, where the kernel and the processor let it.
class InstructionCounter {
 public:
#ifdef __linux__
  InstructionCounter() {
    perf_event_attr wanted{};
    wanted.type = PERF_TYPE_HARDWARE;
    wanted.size = sizeof(wanted);
    wanted.config = PERF_COUNT_HW_INSTRUCTIONS;
    wanted.exclude_kernel = 1;
    wanted.exclude_hv = 1;
    fd_ = static_cast<int>(::syscall(SYS_perf_event_open, &wanted, 0, -1, -1, 0));
  }
  ~InstructionCounter() {
    if (fd_ >= 0) ::close(fd_);
  }
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  std::optional<double> now() const {
    std::uint64_t count = 0;
    if (fd_ < 0 || ::read(fd_, &count, sizeof(count)) != sizeof(count)) return std::nullopt;
    return static_cast<double>(count);
  }

 private:
  int fd_ = -1;
#else
  std::optional<double> now() const { return std::nullopt; }
#endif
};

}  // namespace

StepCost step_cost(const format::Model& model) {
  using Clock = std::chrono::steady_clock;
  const BenchInputs inputs(model, 1);
  WholeCycle cycle(model);
  const auto run = [&](std::size_t i) { return cycle.step(inputs.pose(i), inputs.context(i)); };
  double kept = 0.0;
  for (std::size_t i = 0; i < kSteps / 10; ++i) kept += run(i).X_BC.p(0);
  const InstructionCounter counter;
  const auto before = counter.now();
  for (std::size_t i = 0; i < kSteps; ++i) kept += run(i).X_BC.p(0);
  const auto after = counter.now();
  std::vector<double> us;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const auto begin = Clock::now();
    kept += run(i).X_BC.p(0);
    us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  std::sort(us.begin(), us.end());
  const Build build = this_build();
  StepCost out{.median_us = us[kSteps / 2],
               .p99_us = us[kSteps - kSteps / 100],
               .instructions = {},
               .cpu = look_at_machine().cpu,
               .build = build.instructions,
               .optimised = build.optimised && kept == kept};
  if (before && after && *after > *before) out.instructions = (*after - *before) / kSteps;
  return out;
}

std::string cycle_fault(const StepCost& cost, double cycle_s) {
  const double cycle_us = 1e6 * cycle_s;
  if (!cost.optimised || cost.median_us <= kMostOfCycle * cycle_us) return "";
  return fmt::format(
      "a step takes {:.0f} us on this machine, more than {:.0f} % of the cycle of {:.0f} us",
      cost.median_us, 100.0 * kMostOfCycle, cycle_us);
}

}  // namespace plumb::offline::bench
