// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "plumb/format/model.hpp"

namespace plumb::offline::bench {

/// What a whole step of the cycle costs with one model on this machine: inputs, inverse, guard. Its
/// path is the same for every input, so that the number of instructions is also that of the worst
/// case, to about a percent.
struct StepCost {
  double median_us = 0.0;
  double p99_us = 0.0;
  std::optional<double> instructions;  // of a step; none: the processor does not let us count
  std::string cpu;                     // its model
  std::string build;                   // instruction set that the program is made for
  bool optimised = true;               // and no sanitizer: else the times mean nothing
};

/// Precondition: find_effect_fault finds none in the model. About 30 ms.
StepCost step_cost(const format::Model& model);

/// The largest share of a cycle that a step may take by this measure: the rest is for the bus, for
/// waking up late, and for a slower processor than this one.
inline constexpr double kMostOfCycle = 0.5;

/// Why a step does not fit the cycle; empty if it does, or if the times mean nothing.
std::string cycle_fault(const StepCost& cost, double cycle_s);

}  // namespace plumb::offline::bench
