// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline {

/// The arguments of `plumb add`; a ripple with all its waves:
/// gear_ripple --joints J2 --set cycles_per_turn=7.91,17.49; a step with the rows of all its moves
/// in place of cycles.
std::string adding_arguments(const Cell& cell, const EffectEntry& effect,
                             const std::vector<double>& cycles);

/// One for each effect; those that differ in cycles_per_turn alone go together.
std::vector<std::string> adding_arguments(const Cell& cell,
                                          const std::vector<EffectEntry>& effects);

/// What `plumb drop` takes of effects that were added together: a formula goes by its name.
std::string dropping_arguments(const Cell& cell, const std::vector<EffectEntry>& effects);

}  // namespace plumb::offline
