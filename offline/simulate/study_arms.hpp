// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"

namespace plumb::offline::sim {

/// A heavy six-axis arm from table 2 of the published study with an assumed sixth axis. No masses
/// are stated.
Cell heavy_arm();

/// A light six-axis arm similar to a UR10. No masses are stated.
Cell light_arm();

/// States nominal masses of the links, as a data sheet would, so that the true ones can differ from
/// them.
void state_masses(Cell& cell, double moving_kg);

}  // namespace plumb::offline::sim
