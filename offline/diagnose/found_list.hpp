// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/found.hpp"

namespace plumb::offline {

/// The effects with all entries of what was found: every wave of a ripple is one.
std::vector<EffectEntry> with_found(std::vector<EffectEntry> effects, const Found& found);

/// Takes an effect out of what was found. A wave of a ripple may go alone, and a joint of several;
/// their fellows stay.
void forget(std::vector<Found>& all, const EffectEntry& entry);

}  // namespace plumb::offline
