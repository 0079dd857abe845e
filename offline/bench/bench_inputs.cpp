// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_inputs.hpp"

#include <algorithm>

#include "cell/random.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline::bench {
namespace {

/// Ordinary values of what a cell measures.
constexpr double kPayloads_kg = 10.0, kReach_m = 0.1, kColdest_degC = 15.0, kWarmest_degC = 45.0,
                 kHour_s = 3600.0;

double between(Random& random, double low, double high) {
  return low + (high - low) * random.unit();
}

double joint_at_random(const format::Model& model, std::size_t i, Random& random) {
  const format::JointRow& row = model.nominal.joints[i];
  if (i >= model.domain.q_min.size()) return between(random, row.q_min, row.q_max);
  const double low = std::max(row.q_min, model.domain.q_min[i]);
  const double high = std::min(row.q_max, model.domain.q_max[i]);
  return low <= high ? between(random, low, high)
                     : between(random, model.domain.q_min[i], model.domain.q_max[i]);
}

Context everything_known(Random& random) {
  Context out;
  for (double& x : out.direction) x = random.below(2) == 0 ? -1.0 : 1.0;
  for (double& x : out.travel) x = random.unit();
  for (double& x : out.temperature_degC) x = between(random, kColdest_degC, kWarmest_degC);
  out.payload_kg = between(random, 0.0, kPayloads_kg);
  for (double& x : out.payload_com_m) x = between(random, -kReach_m, kReach_m);
  out.time_s = between(random, 0.0, kHour_s);
  return out;
}

}  // namespace

BenchInputs::BenchInputs(const format::Model& model, std::uint64_t seed)
    : poses_(kPoses), contexts_(kContexts) {
  Random random(seed);
  const Chain nominal(model.nominal);
  const std::size_t n = model.nominal.joints.size();
  for (BenchPose& pose : poses_) {
    for (std::size_t i = 0; i < n; ++i) pose.q[i] = joint_at_random(model, i, random);
    pose.X_BD = nominal.forward(std::span<const double>(pose.q).first(n));
  }
  for (Context& context : contexts_) context = everything_known(random);
}

}  // namespace plumb::offline::bench
