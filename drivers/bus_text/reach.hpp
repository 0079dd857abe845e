// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/format/model.hpp"

namespace plumb::drivers {

/// What the numbers of classic CAN frames are too small for: a joint's limits, or the largest
/// correction as an offset. It would arrive cut off. CAN FD and Modbus have 32 bits for everything.
/// `path`: of the layout's table, for the help: "bus".
std::vector<LayoutFault> find_short_reach(const BusLayout& layout, const format::Chain& chain,
                                          double max_correction_m, const std::string& path);

}  // namespace plumb::drivers
