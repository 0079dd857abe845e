// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cell/cell.hpp"
#include "simulate/hidden_effect.hpp"

namespace plumb::offline {

/// Reads the specification of a hidden effect. Throws Failure (kUsage) with a caret and "did you
/// mean".
HiddenEffect parse_hidden_effect(const std::string& spec, const Cell& cell);

/// The effects of the simulator, with one line each for --help.
const std::vector<std::pair<std::string, std::string>>& simulated_effects();

}  // namespace plumb::offline
