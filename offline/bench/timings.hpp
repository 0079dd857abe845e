// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/timing.hpp"

namespace plumb::offline::bench {

struct TimingRequest {
  long calls = 100000;  // of each kernel, warm and chained
  static constexpr long kMostCalls = 10'000'000;

  /// Cold calls: fewer, because a sweep takes a thousand times as long as a call.
  long cold_calls() const;
};

struct Timings {
  std::vector<Timing> all;        // every kernel warm, then chained, then cold
  double clock_ns = 0.0;          // taken off every reading
  std::uint64_t allocations = 0;  // in all timed calls together

  const Timing& of(Part part, Way way) const;

  /// What an effect or the trees add: its median without that of the chain alone [ns].
  double added(const Timing& timing) const;
};

/// Times every kernel each way, in turns, so that a machine that becomes slower does so for all.
///
/// One timing covers several calls, 2 us at least, so that the cost of reading the clock hardly
/// counts. Chained cycles and cold calls are timed one by one, so that their worst value is that of
/// one call. The cost of the clock is subtracted from each timing.
Timings time_kernels(std::span<const CycleKernel> kernels, const TimingRequest& request);

}  // namespace plumb::offline::bench
