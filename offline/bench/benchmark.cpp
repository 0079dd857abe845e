// SPDX-License-Identifier: Apache-2.0
#include "bench/benchmark.hpp"

#include "bench/step_instructions.hpp"

namespace plumb::offline::bench {

Benchmark benchmark(const format::Model& model, const TimingRequest& request, std::uint64_t seed) {
  const Machine machine = look_at_machine();
  const Build build = this_build();
  const BenchInputs inputs(model, seed);
  const CycleKernels kernels(model, inputs);
  return {.timings = time_kernels(kernels.all(), request),
          .machine = machine,
          .build = build,
          .why_not_representative = why_not_representative(machine, build),
          .instructions = step_instructions(model),
          .baseline = baseline_instructions(model),
          .cycle_s = model.guard.cycle_s,
          .poses = BenchInputs::kPoses,
          .refused_poses = kernels.refused_poses(),
          .seed = seed};
}

}  // namespace plumb::offline::bench
