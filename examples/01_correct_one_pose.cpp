// SPDX-License-Identifier: Apache-2.0
// Loads a model and corrects one pose: 01_correct_one_pose robot.plumb
#include <cstdio>
#include <plumb/robot.hpp>

int main(int count, char** arguments) {
  const auto [robot, error] = plumb::Robot::load(count == 2 ? arguments[1] : "robot.plumb");
  if (!robot) return std::fprintf(stderr, "%s\n", error->text.c_str()), 3;

  // The target, and the joint positions by which the controller means to reach it.
  plumb::CycleInput in{.target = plumb::Arrival::kArrived, .joints = plumb::Arrival::kArrived};
  in.q_measured = in.q_commanded = {0.3, 0.8};
  in.X_BD = robot->nominal_pose(in.q_commanded);

  // The cycle: fixed cost, never allocates, always returns. The correction ramps in.
  plumb::CycleOutput out;
  for (int cycle = 0; cycle < 1000; ++cycle, in.now_ns += 4'000'000) out = robot->correct(in);

  const plumb::Vector3 shift_mm = (out.output.X_BC.p - in.X_BD.p) * 1e3;
  std::printf("status %s, correction [%.4f %.4f %.4f] mm\n", to_string(out.output.status),
              shift_mm(0), shift_mm(1), shift_mm(2));
  return out.output.has_output ? 0 : 1;
}
