// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"

namespace plumb::offline::bench {

/// The instructions of a whole step of the cycle at worst, by a sum over what the model is made of:
/// joints, laws with their joints and numbers, operations of formulas, trees. The terms were
/// counted with callgrind in the preset release-v3 of g++ 12 (tests/rt/count_steps), and a gate
/// holds the sum against counts of whole models. Other compilers take more or fewer.
double step_instructions(const format::Model& model);

/// The same for the build that runs on every x86-64 processor (preset release): the arm alone is
/// counted likewise, what effects and trees add is estimated from the sum above.
double baseline_instructions(const format::Model& model);

}  // namespace plumb::offline::bench
