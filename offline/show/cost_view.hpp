// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bench/step_cost.hpp"
#include "program/json.hpp"

namespace plumb::offline::show {

/// {instructions, step_us, worst_us, cpu, build}
Json cost_json(const bench::StepCost& cost);

/// A sentence on what a step of the cycle costs, and where that was measured.
std::string cost_text(const bench::StepCost& cost);

}  // namespace plumb::offline::show
