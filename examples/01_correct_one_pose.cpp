// SPDX-License-Identifier: Apache-2.0
// Loads a model and corrects one pose: 01_correct_one_pose robot.plumb
#include <cstdio>
#include <vector>

#include "examples/model_file.hpp"
#include "plumb/runtime/guard.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: 01_correct_one_pose robot.plumb\n");
    return 2;
  }

  // Load: slow, may allocate, may fail.
  const auto loaded = load_or_exit(arguments[1]);
  const plumb::Corrector& corrector = loaded->corrector();
  plumb::Guard guard(loaded->limits());

  // The target: where the controller believes the arm is past the middle of its joint ranges.
  std::vector<double> seed;
  for (const auto& joint : loaded->model().nominal.joints)
    seed.push_back(0.6 * joint.q_max + 0.4 * joint.q_min);
  const plumb::Transformd X_BD = corrector.nominal().forward(seed);

  // Cycle: fixed cost, never allocates, always returns.
  const plumb::Correction correction = corrector.solve(X_BD, seed, plumb::SeedKind::kCommanded);
  plumb::GuardOutput output;
  for (int cycle = 0; cycle < 1000; ++cycle)
    output = guard.step(X_BD, correction, loaded->limits().cycle_s);

  const plumb::Vector3 shift = (correction.X_BC.p - X_BD.p) * 1e3;
  const plumb::Vector3 sent = (output.X_BC.p - X_BD.p) * 1e3;
  std::printf("status %s, correction [%.4f %.4f %.4f] mm, sent [%.4f %.4f %.4f] mm\n",
              to_string(correction.status), shift(0), shift(1), shift(2), sent(0), sent(1),
              sent(2));
  return output.has_output && (shift - sent).norm() < 1e-6 ? 0 : 1;
}
