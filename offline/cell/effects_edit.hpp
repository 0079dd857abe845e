// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline {

/// Whether two entries say the same, wherever they stand.
bool same_effect(const EffectEntry& a, const EffectEntry& b);

/// The cell's text with `effects` in place of its own: entries are added, taken out, or get other
/// joints where they stand; comments, order and layout of the rest survive. Throws Failure (kInput)
/// if an effect is not one the reader accepts, or if the layout cannot be edited in place.
std::string edited_effects(const Cell& cell, const std::vector<EffectEntry>& effects);

/// "[effects.gear_ripple]\njoints = ["J2"]\ncycles_per_turn = 20\n"; [[...]] if it is one of
/// several.
std::string effect_text(const Cell& cell, const EffectEntry& effect, bool several);

}  // namespace plumb::offline
