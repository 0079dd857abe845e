// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// Waves of a joint that has some already: those were found while something else was missing. All
/// of them are looked for again, together, where the model then stands. Returns what is to be added
/// then; anything but waves, and waves of a joint that has none, as given.
Found with_fresh_waves(Selection& selection, Found best);

}  // namespace plumb::offline
