// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline::cli {

/// Two effects as --separate takes them: "reversal:J2,settling_lag:J2+J3" or
/// "gear_ripple:J2@cycles_per_turn=20,gear_harmonics". What the cell lists of that name lends its
/// joints and numbers where none are given. Throws Failure (kUsage, E-PLAN-EFFECT).
std::vector<EffectEntry> two_effects(const Cell& cell, const std::string& text);

}  // namespace plumb::offline::cli
