// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "simulate/hidden_effect.hpp"

namespace plumb::offline {

/// The specification that reads back to this effect, whose size must not be stated in sigma.
std::string hidden_effect_text(const HiddenEffect& effect, const Cell& cell);

}  // namespace plumb::offline
