// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bench/step_cost.hpp"
#include "program/json.hpp"

namespace plumb::offline::show {

/// {instructions, instructions_baseline, step_us, worst_us, cpu, build, representative, ...}
Json cost_json(const bench::StepCost& cost);

/// A sentence on the instructions of a step, with AVX2 and without.
std::string instructions_text(double instructions, double baseline);

/// What a step of the cycle costs, where that was timed, and whether those times say anything of a
/// controller.
std::string cost_text(const bench::StepCost& cost);

}  // namespace plumb::offline::show
