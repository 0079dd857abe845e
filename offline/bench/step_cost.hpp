// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::offline::bench {

/// What a whole step of the cycle costs with one model: inputs, inverse, guard. Its path is the
/// same for every input, so that the instructions are those of the worst case.
struct StepCost {
  double instructions = 0.0;  // of step_instructions
  double baseline = 0.0;      // of baseline_instructions
  double median_us = 0.0;     // of steps that were timed one by one
  double worst_us = 0.0;      // 99 % of them were faster; the rest was interrupted
  std::string cpu;            // on which they were timed; empty if the machine does not say
  std::string build;          // instruction set that the program is made for
  bool optimised = true;      // and no sanitizer: else the times mean nothing
  std::vector<std::string> why_not_representative;  // of a controller; empty: the times are
};

/// Precondition: find_effect_fault finds none in the model. About 2,000 steps.
StepCost step_cost(const format::Model& model);

/// The largest share of a cycle that a step may take: the rest is for the bus, for waking up late,
/// and for a slower processor than this one.
inline constexpr double kMostOfCycle = 0.5;

/// Why a step does not fit the cycle; empty if it does, or if the times mean nothing.
std::string cycle_fault(const StepCost& cost, double cycle_s);

}  // namespace plumb::offline::bench
