// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/cycle_kernels.hpp"

namespace plumb::offline::bench {

/// kWarm: back to back, nothing waits for anything. kChain: each input waits for the output before.
/// kCold: one call after the caches were swept.
enum class Way { kWarm, kChain, kCold };

/// How long one kernel took one way. `ns` has one number for each reading of the clock, in
/// ascending order: the mean over calls_per_reading calls, without the cost of the clock.
struct Timing {
  Part part = Part::kCycle;
  std::string label;
  Way way = Way::kWarm;
  long calls_per_reading = 1;
  std::vector<double> ns = {};

  long calls() const { return calls_per_reading * static_cast<long>(ns.size()); }

  /// A quantile: the smallest reading that at least this share (0 .. 1) of the readings does not
  /// exceed.
  double at_share(double share) const;
  double median() const { return at_share(0.5); }
  double p99() const { return at_share(0.99); }
  double most() const { return ns.back(); }
};

}  // namespace plumb::offline::bench
