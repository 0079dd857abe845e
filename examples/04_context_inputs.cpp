// SPDX-License-Identifier: Apache-2.0
// What an effect must be told, and what happens when that grows too old. The robot's model reads a
// temperature and the direction of each joint: 04_context_inputs robot.plumb
#include <algorithm>
#include <cstdio>

#include "examples/model_file.hpp"
#include "plumb/runtime/cycle.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: 04_context_inputs robot.plumb\n");
    return 2;
  }
  const auto loaded = load_or_exit(arguments[1]);
  const std::string* sensor = plumb::temperature_name(loaded->model(), 0);
  std::printf("sensor 0 is %s\n", sensor == nullptr ? "not read" : sensor->c_str());
  plumb::ModelSlot slot(*loaded);
  plumb::Cycle cycle(slot, {.context = {.temperature_s = 1.0}});

  std::array<double, 2> q{0.3, 0.8};
  plumb::CycleInput input;
  input.target = input.joints = plumb::Arrival::kArrived;
  plumb::Status fresh = plumb::Status::kNoModel, stale = plumb::Status::kNoModel;
  for (int k = 0; k < 1000; ++k) {
    input.now_ns += 4'000'000;
    // Up for a second, down for a second, then at rest: the direction is held.
    for (double& x : q) x += k < 250 ? 4e-4 : k < 500 ? -4e-4 : 0.0;
    input.X_BD = loaded->corrector().nominal().forward(q);
    std::copy(q.begin(), q.end(), input.q_measured.begin());
    // The sensor reports once a second, 20 ms late, and falls silent after two.
    input.context = {};
    if (k % 250 == 0 && k <= 500) input.context.temperature_degC[0] = {29.0 + 0.01 * k, 0.02};
    const plumb::CycleOutput step = cycle.step(input);
    if (k == 700) fresh = step.correction.status;
    if (k == 999) stale = step.correction.status;
    if (k % 100 == 99)
      std::printf("%4.1f s  direction %+.0f  travel %.3f rad  temperature %5.1f degC  %s\n",
                  0.004 * k, cycle.context().direction[0], cycle.context().travel[0],
                  cycle.context().temperature_degC[0], to_string(step.correction.status));
  }
  const bool told = fresh == plumb::Status::kOk && cycle.context().direction[0] == -1.0;
  return told && stale == plumb::Status::kContextFallback ? 0 : 1;
}
