// SPDX-License-Identifier: Apache-2.0
// A 1 kHz loop around the corrector and the guard at SCHED_FIFO, while others at normal priority
// load the same processor: how late does it wake up? tests/can_machine/rt_latency runs it under
// virtual time.
//   rt_loop CYCLES LIMIT_US [none|other|rival]
// The last word plants a violation: a loop that is not SCHED_FIFO, or a thread above it that keeps
// the processor for 200 us. Exit code 1 when the worst wake-up exceeds the limit, 5 when the
// machine denies what the loop needs.
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "plumb/drivers/cycle_clock.hpp"
#include "plumb/drivers/rt_process.hpp"
#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/guard.hpp"
#include "tests/rt/one_arm.hpp"

namespace {

using namespace plumb;
using namespace plumb::drivers;

// 1 kHz, but for 0.7 us: the grid slides over the kernel's own tick of 4 ms, once in 5714 cycles,
// and so meets it at its worst. At 1 kHz sharp the phase at the start would decide what is seen.
constexpr std::int64_t kPeriod_ns = 1'000'700;
constexpr int kPriority = 80;
constexpr std::int64_t kRivalBusy_ns = 200'000, kRivalRest_ns = 9'900'000;

struct Options {
  long cycles = 0;
  long limit_us = 0;
  std::string planted = "none";
};

/// A child that does `work` until it is killed, or its parent ends.
template <class F>
pid_t in_background(F work) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (;;) work();
}

void compute() {
  static volatile double x = 1.0;
  for (int i = 0; i < 1000; ++i) x = std::sqrt(x + i);
}

/// System calls that take locks and pages: pipes, memory maps, files in memory, processes.
void bother_the_kernel() {
  int ends[2];
  char text[4096] = {};
  if (::pipe(ends) != 0) return;
  std::ignore = ::write(ends[1], text, sizeof(text));
  std::ignore = ::read(ends[0], text, sizeof(text));
  ::close(ends[0]);
  ::close(ends[1]);
  constexpr std::size_t kBytes = 1 << 20;
  void* const map =
      ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (map != MAP_FAILED) std::memset(map, 1, kBytes);
  if (map != MAP_FAILED) ::munmap(map, kBytes);
  const int file = ::open("/dev/shm/rt_loop", O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  std::ignore = ::write(file, text, sizeof(text));
  ::close(file);
}

/// Above the loop's priority, 200 us in every 10 ms.
void hold_the_processor() {
  const MonotonicTime time;
  const std::int64_t begin_ns = time.now_ns();
  while (time.now_ns() - begin_ns < kRivalBusy_ns) {
  }
  std::ignore = time.sleep_until_ns(time.now_ns() + kRivalRest_ns);
}

pid_t start_rival() {
  return in_background([] {
    sched_param parameter{};
    parameter.sched_priority = kPriority + 1;
    ::sched_setscheduler(0, SCHED_FIFO, &parameter);
    hold_the_processor();
  });
}

std::vector<pid_t> start_load(const Options& options) {
  std::vector<pid_t> out = {in_background(compute), in_background(bother_the_kernel)};
  if (options.planted == "rival") out.push_back(start_rival());
  return out;
}

/// Returns how many outputs were valid.
long run_cycles(CycleClock<>& clock, const Corrector& corrector, Guard& guard, long cycles) {
  long valid = 0;
  for (long i = 0; i < cycles; ++i) {
    const Tick tick = clock.wait();
    const double swing = 0.3 * std::sin(1e-3 * static_cast<double>(i));
    const std::array<double, 6> q = {swing, -1.0 + swing, 1.2, -0.4, 1.1 - swing, 0.2};
    const Prediction prediction = corrector.forward_model().predict(q);
    const Correction correction = corrector.solve(prediction.X_BT, q, SeedKind::kMeasured);
    const double dt_s = 1e-9 * static_cast<double>(tick.elapsed_ns);
    const GuardOutput output = guard.step(prediction.X_BT, correction, dt_s);
    valid += output.has_output && !refused(output.status) ? 1 : 0;
  }
  return valid;
}

void print_steps(const RtProcess& process) {
  for (const auto& step : process.steps()) {
    const Finding finding = describe(step);
    std::printf("%-8s %-14s %s\n", to_string(finding.grant), finding.what.c_str(),
                finding.why.c_str());
  }
}

/// A line for every power of two that occurred.
void print_histogram(const LatencyHistogram& latency) {
  constexpr std::size_t kOctave = LatencyHistogram::kBinsPerOctave;
  for (std::size_t i = 0; i < LatencyHistogram::kBins; i += kOctave) {
    std::uint64_t count = 0;
    for (std::size_t k = i; k < i + kOctave; ++k) count += latency.in_bin(k);
    if (count > 0)
      std::printf("  from %9.3f us: %llu\n",
                  1e-3 * static_cast<double>(LatencyHistogram::lower_ns(i)),
                  static_cast<unsigned long long>(count));
  }
}

void print_result(const CycleClock<>& clock, long valid) {
  const char* const machine = std::getenv("PLUMB_VIRTUAL_TIME");
  const bool is_virtual = machine != nullptr && *machine != '\0';
  std::printf("%s\n", is_virtual ? "virtual time: structure, not hardware"
                                 : "time of this machine: says nothing of another");
  print_histogram(clock.latency());
  const auto us = [&](double share) {
    return 1e-3 * static_cast<double>(clock.latency().percentile_ns(share));
  };
  std::printf("ticks %llu, missed %llu, valid outputs %ld\n",
              static_cast<unsigned long long>(clock.counters().ticks),
              static_cast<unsigned long long>(clock.counters().missed), valid);
  std::printf("wake-up [us]: median %.3f, p99 %.3f, p99.9 %.3f, worst %.3f\n", us(0.5), us(0.99),
              us(0.999), us(1.0));
}

int measure(const Options& options) {
  const format::Model model = tests::one_arm();
  const Corrector corrector(model);
  Guard guard(model.guard);
  const auto load = start_load(options);
  const RtProcess process({.priority = options.planted == "other" ? 0 : kPriority});
  CycleClock<> clock(kPeriod_ns);
  const long valid = run_cycles(clock, corrector, guard, options.cycles);
  for (const pid_t child : load) ::kill(child, SIGKILL);
  print_steps(process);
  print_result(clock, valid);
  if (process.step(RtStepKind::kPriority).grant == Grant::kDenied || valid == 0) return 5;
  const bool kept = clock.latency().worst_ns() <= options.limit_us * 1000;
  std::printf("worst wake-up %s %ld us\n", kept ? "within" : "BEYOND", options.limit_us);
  return kept ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (argc > 1) options.cycles = std::atol(argv[1]);
  if (argc > 2) options.limit_us = std::atol(argv[2]);
  if (argc > 3) options.planted = argv[3];
  const bool known =
      options.planted == "none" || options.planted == "other" || options.planted == "rival";
  if (options.cycles > 0 && options.limit_us > 0 && known) return measure(options);
  std::fprintf(stderr, "usage: rt_loop CYCLES LIMIT_US [none|other|rival]\n");
  return 2;
}
