// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"

namespace plumb::offline::sim {

/// Heavy six-axis arm, table 2 of the published study and an assumed sixth axis: no masses stated.
Cell heavy_arm();

/// Light six-axis arm, UR10-like: no masses stated.
Cell light_arm();

/// Adds nominal masses of the links, as a data sheet would give them, so that they can be wrong.
void state_masses(Cell& cell, double moving_kg);

}  // namespace plumb::offline::sim
