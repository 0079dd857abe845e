// SPDX-License-Identifier: Apache-2.0
// The whole cycle, in simulated time: a target that moves, a bus that falls silent for half a
// second, and the correction that ramps in, out and in again: 03_cycle_at_250_hz robot.plumb
#include <algorithm>
#include <cstdio>
#include <vector>

#include "examples/model_file.hpp"
#include "plumb/runtime/cycle.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: 03_cycle_at_250_hz robot.plumb\n");
    return 2;
  }
  const auto loaded = load_or_exit(arguments[1]);
  plumb::ModelSlot slot(*loaded);
  plumb::Cycle cycle(slot);

  std::vector<double> q;
  for (const auto& joint : loaded->model().nominal.joints)
    q.push_back(0.6 * joint.q_max + 0.4 * joint.q_min);
  constexpr double kSpeed = 0.1;  // [rad/s]
  plumb::CycleInput input;
  plumb::Vector3 before = plumb::Vector3::Zero();
  double largest_step_m = 0.0;
  for (int k = 0; k < 1500; ++k) {
    const bool silent = k >= 600 && k < 725;
    input.now_ns += 4'000'000;
    input.target = input.joints = silent ? plumb::Arrival::kNothingNew : plumb::Arrival::kArrived;
    if (!silent) {
      for (double& x : q) x += kSpeed * 0.004;
      input.X_BD = loaded->corrector().nominal().forward(q);
      for (std::size_t i = 0; i < q.size(); ++i) input.q_measured[i] = q[i];
    }
    const plumb::GuardOutput sent = cycle.step(input).output;
    const plumb::Vector3 added = sent.X_BC.p - input.X_BD.p;
    largest_step_m = std::max(largest_step_m, (added - before).norm());
    before = added;
    if (k % 100 == 0)
      std::printf("%5.1f s  %-16s correction %7.4f mm\n", 0.004 * k, to_string(sent.status),
                  1e3 * added.norm());
  }
  const plumb::GuardCounters& counted = cycle.counters();
  std::printf("%llu cycles, %llu of them stale, largest step %.4f mm\n",
              static_cast<unsigned long long>(counted.steps),
              static_cast<unsigned long long>(counted.stale), 1e3 * largest_step_m);
  return largest_step_m <= loaded->limits().slew_m_per_s * 0.004 + 1e-12 ? 0 : 1;
}
