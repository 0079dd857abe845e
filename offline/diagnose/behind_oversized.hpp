// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// An effect of a size that hardly any arm has may describe something else: it does if its law
/// rules that size out, if a pattern of no law explains as much, or if it leaves more than noise.
/// Otherwise it is what it says, only large: a wrong constant, a worn gear.
///
/// @param unlikely  Receives those that are only large, up to the first that is something else.
std::optional<UnknownStructure> behind_oversized(Selection& selection,
                                                 std::vector<Oversized>& unlikely);

}  // namespace plumb::offline
