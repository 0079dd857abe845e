// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"

namespace plumb::offline::bench {

/// The instructions of a whole step of the cycle at worst, by a sum over what the model is made of:
/// joints, laws with their joints and numbers, operations of formulas, trees. The terms were
/// counted with callgrind in the preset release-v3 of g++ 12 (tests/rt/count_steps), and a gate
/// holds the sum against counts of whole models. Other compilers and instruction sets take more or
/// fewer.
double step_instructions(const format::Model& model);

}  // namespace plumb::offline::bench
