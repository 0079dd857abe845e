// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// Turns every split of a crisp tree into a C1 ramp: half width = overlap x the distance from the
/// threshold to the nearer wall of the cell it divides, 0 < overlap <= 1. The splits are along
/// single inputs. The coefficients of the leaves are not changed. The tree must be fitted again
/// afterwards, or it is worse than before.
void add_ramps(format::Tree& tree, double overlap);

}  // namespace plumb::offline
