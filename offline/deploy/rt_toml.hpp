// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/bus_layout.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// rt.toml for a cell: every table and key with what it is for, so that nothing need be looked up
/// on the machine. plumb-rt reads it. `guard`: the limits that follow from [deploy] of the cell;
/// they become the ceilings of every model that runs there. `[deploy] address` of the cell may end
/// with a port, as in "127.0.0.1:1502"; without one it is that of Modbus, 502.
std::string write_rt_toml(const Cell& cell, const drivers::BusLayout& layout,
                          const format::GuardLimits& guard,
                          drivers::CorrectionMode mode = drivers::CorrectionMode::kShadow);

}  // namespace plumb::offline
