// SPDX-License-Identifier: Apache-2.0
#include "bench/timings.hpp"

#include <algorithm>
#include <stdexcept>

#include "bench/allocations.hpp"
#include "bench/cache_sweep.hpp"
#include "bench/stopwatch.hpp"

namespace plumb::offline::bench {
namespace {

constexpr long kRounds = 10;  // in which all kernels take turns
constexpr long kCallsPerColdCall = 100, kMostColdCalls = 1000;
constexpr std::size_t kWarmUp = 64;  // calls
constexpr double kShortestReading_ns = 2e3;
constexpr int kTries = 5;  // the fastest counts: the others were disturbed
constexpr int kSearches = 5;

class Clock {
 public:
  /// One reading over `calls` calls [ns].
  double reading(Kernel& kernel, std::size_t calls, Chaining chaining) {
    const std::uint64_t before = bench::allocations();
    const double begin = now_ns();
    sink_ = kernel.run(next_, calls, chaining);
    const double took = now_ns() - begin;
    allocations_ += bench::allocations() - before;
    next_ += calls;
    return std::max(0.0, took - cost_ns_);
  }

  double cost_ns() const { return cost_ns_; }
  std::uint64_t allocations() const { return allocations_; }

 private:
  double cost_ns_ = clock_cost_ns();
  std::size_t next_ = 0;  // input
  std::uint64_t allocations_ = 0;
  volatile double sink_ = 0.0;
};

Chaining chaining(Way way) { return way == Way::kChain ? Chaining::kChained : Chaining::kFree; }

/// Smallest power of two of calls, `most` at most, whose fastest try takes kShortestReading_ns.
long enough_calls_once(Clock& clock, Kernel& kernel, Way way, long most) {
  for (long calls = 1;; calls *= 2) {
    if (2 * calls > most) return calls;
    double fastest = kShortestReading_ns;
    for (int i = 0; i < kTries; ++i)
      fastest =
          std::min(fastest, clock.reading(kernel, static_cast<std::size_t>(calls), chaining(way)));
    if (fastest >= kShortestReading_ns) return calls;
  }
}

/// A disturbance makes a call look longer, so that fewer calls seem enough. Therefore the largest
/// result of several searches is used.
long enough_calls(Clock& clock, Kernel& kernel, Way way, long most) {
  long out = 1;
  for (int i = 0; i < kSearches; ++i)
    out = std::max(out, enough_calls_once(clock, kernel, way, most));
  return out;
}

class Timer {
 public:
  Timer(const CycleKernel& kernel, Way way, long calls, Clock& clock)
      : kernel_(*kernel.kernel), clock_(clock), calls_(calls) {
    out_ = {.part = kernel.part, .label = kernel.label, .way = way};
    const bool one_by_one =
        way == Way::kCold || (way == Way::kChain && kernel.part == Part::kCycle);
    if (!one_by_one) out_.calls_per_reading = enough_calls(clock, kernel_, way, calls / kRounds);
    out_.ns.reserve(static_cast<std::size_t>(readings()));
  }

  void round(long i, CacheSweep& caches) {
    const long first = readings() * i / kRounds, end = readings() * (i + 1) / kRounds;
    if (out_.way != Way::kCold) warm_up();
    for (long k = first; k < end; ++k) {
      if (out_.way == Way::kCold) caches.sweep();
      out_.ns.push_back(reading());
    }
  }

  Timing timing() && {
    std::sort(out_.ns.begin(), out_.ns.end());
    return std::move(out_);
  }

 private:
  long readings() const { return std::max(1L, calls_ / out_.calls_per_reading); }

  void warm_up() { clock_.reading(kernel_, kWarmUp, chaining(out_.way)); }

  double reading() {
    const long calls = out_.calls_per_reading;
    return clock_.reading(kernel_, static_cast<std::size_t>(calls), chaining(out_.way)) /
           static_cast<double>(calls);
  }

  Kernel& kernel_;
  Clock& clock_;
  long calls_;
  Timing out_;
};

void time_way(std::span<const CycleKernel> kernels, Way way, const TimingRequest& request,
              Clock& clock, std::vector<Timing>& out) {
  const long calls = way == Way::kCold ? request.cold_calls() : request.calls;
  std::vector<Timer> timers;
  for (const CycleKernel& kernel : kernels) timers.emplace_back(kernel, way, calls, clock);
  CacheSweep caches;
  for (long i = 0; i < kRounds; ++i)
    for (Timer& timer : timers) timer.round(i, caches);
  for (Timer& timer : timers) out.push_back(std::move(timer).timing());
}

}  // namespace

long TimingRequest::cold_calls() const {
  return std::clamp(calls / kCallsPerColdCall, 1L, kMostColdCalls);
}

const Timing& Timings::of(Part part, Way way) const {
  const auto it = std::find_if(all.begin(), all.end(),
                               [&](const Timing& t) { return t.part == part && t.way == way; });
  if (it == all.end()) throw std::logic_error("this part of the cycle was not timed");
  return *it;
}

double Timings::added(const Timing& timing) const {
  return timing.median() - of(Part::kKinematics, timing.way).median();
}

Timings time_kernels(std::span<const CycleKernel> kernels, const TimingRequest& request) {
  Timings out;
  Clock clock;
  for (const Way way : {Way::kWarm, Way::kChain, Way::kCold})
    time_way(kernels, way, request, clock, out.all);
  out.clock_ns = clock.cost_ns();
  out.allocations = clock.allocations();
  return out;
}

}  // namespace plumb::offline::bench
