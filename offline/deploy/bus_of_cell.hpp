// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "plumb/drivers/bus_layout.hpp"

namespace plumb::offline {

/// The layout of the cell, [deploy.bus] or the default one. Throws Failure (kInput, E-CELL-BUS)
/// with everything that makes it unusable for `use`.
drivers::BusLayout bus_of(const Cell& cell, drivers::BusUse use);

}  // namespace plumb::offline
