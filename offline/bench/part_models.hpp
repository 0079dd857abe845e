// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "plumb/format/model.hpp"

/// A model with part of what it has, to see what the part costs.
namespace plumb::offline::bench {

/// The calibrated chain, without effects and trees.
format::Model chain_alone(format::Model model);

/// The chain and one effect.
format::Model with_one_effect(format::Model model, std::size_t effect);

/// The chain and the trees.
format::Model with_trees_alone(format::Model model);

/// "joint_compliance:J2+J3"; a formula goes by its name.
std::string effect_label(const format::Model& model, std::size_t effect);

}  // namespace plumb::offline::bench
