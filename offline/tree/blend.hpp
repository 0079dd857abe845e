// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"
#include "tree/samples.hpp"

namespace plumb::offline {

/// Turns every split of a crisp tree into a C1 ramp: half width = overlap x the distance from the
/// threshold to the nearer wall of the cell it divides, 0 < overlap <= 1. For an oblique split the
/// walls are given by the outermost samples of the cell. u: (n, p), the training samples.
/// The coefficients of the leaves are not changed. The tree must be fitted again afterwards, or it
/// is worse than before.
void add_ramps(format::Tree& tree, const Samples& u, double overlap);

}  // namespace plumb::offline
