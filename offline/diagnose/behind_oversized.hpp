// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// An effect of a size that hardly any arm has may stand for something else. That is assumed if its
/// law rules the size out, if a pattern that belongs to no law explains as much, or if more than
/// noise is left. Otherwise it is the effect itself, only large: a wrong constant, a worn gear.
///
/// @param unlikely  Receives those that are only large, up to the first that is something else.
std::optional<UnknownStructure> behind_oversized(Selection& selection,
                                                 std::vector<Oversized>& unlikely);

}  // namespace plumb::offline
