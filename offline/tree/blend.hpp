// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"
#include "tree/samples.hpp"

namespace plumb::offline {

/// Turns every split of a crisp tree into a C1 ramp: half width = overlap x the distance from the
/// threshold to the nearer wall of the cell it divides, 0 < overlap <= 1. The walls of an oblique
/// split are the outermost of the cell's own samples. u: (n, p), the training samples.
/// Leaf coefficients are left as they are; without refitting them the tree gets worse.
void add_ramps(format::Tree& tree, const Samples& u, double overlap);

}  // namespace plumb::offline
