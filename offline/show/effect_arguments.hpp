// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"

namespace plumb::offline::show {

/// gear_ripple --joints J2 --set cycles_per_turn=20: what `plumb add` takes.
std::string adding_arguments(const Cell& cell, const EffectEntry& effect);

/// The same for `plumb drop`: a formula goes by its name.
std::string dropping_arguments(const Cell& cell, const EffectEntry& effect);

/// gravity_free:J2+J3: what `plumb plan --separate` takes two of.
std::string planning_argument(const Cell& cell, const EffectEntry& effect);

}  // namespace plumb::offline::show
