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
/// with a port, as in "127.0.0.1:1502"; without one it is that of Modbus, 502. `made`: the time of
/// now in UTC, as "2026-11-25T15:00:00Z", by which plumb-rt tells an older folder from a newer one;
/// empty: it is left out.
std::string write_rt_toml(const Cell& cell, const drivers::BusLayout& layout,
                          const format::GuardLimits& guard,
                          drivers::CorrectionMode mode = drivers::CorrectionMode::kShadow,
                          const std::string& made = "");

}  // namespace plumb::offline
