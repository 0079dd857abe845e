// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/build.hpp"
#include "bench/machine.hpp"
#include "bench/timings.hpp"

namespace plumb::offline::bench {

/// What `plumb bench` found.
struct Benchmark {
  Timings timings;
  Machine machine;
  Build build;
  std::vector<std::string> why_not_representative;  // empty if it is
  double instructions = 0.0, baseline = 0.0;        // as in StepCost
  double cycle_s = 0.0;                             // for which the model is made
  std::size_t poses = 0;
  std::size_t refused_poses = 0;
  std::uint64_t seed = 0;

  /// Correct and guard, each call waiting for the one before, timed one by one.
  const Timing& cycle() const { return timings.of(Part::kCycle, Way::kChain); }
};

/// Looks at the machine, then times the model.
Benchmark benchmark(const format::Model& model, const TimingRequest& request, std::uint64_t seed);

}  // namespace plumb::offline::bench
