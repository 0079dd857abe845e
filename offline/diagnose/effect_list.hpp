// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"

namespace plumb::offline {

/// The effects with `entry` added: its joints join an entry of the same effect with the same
/// options; otherwise it stands for itself.
std::vector<EffectEntry> with_effect(std::vector<EffectEntry> effects, const EffectEntry& entry);

/// Without it, or without these joints of it; the options must agree where `entry` has some.
std::vector<EffectEntry> without_effect(std::vector<EffectEntry> effects, const EffectEntry& entry);

/// What `before` has and `after` lacks: whole entries, or some of their joints.
std::vector<EffectEntry> taken_out(const std::vector<EffectEntry>& before,
                                   const std::vector<EffectEntry>& after);

/// Whether the entry lists joints, all of which slide.
bool all_slide(const Cell& cell, const EffectEntry& entry);

/// Whether the list already has that effect at all these joints, options alike.
bool has_effect(const std::vector<EffectEntry>& effects, const EffectEntry& entry);

}  // namespace plumb::offline
