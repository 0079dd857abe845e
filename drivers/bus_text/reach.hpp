// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/format/model.hpp"

namespace plumb::drivers {

/// Finds the quantities for which the numbers of classic CAN frames are too small: the limits of a
/// joint, or the largest correction sent as an offset. They would arrive saturated. CAN FD and
/// Modbus have 32 bits for every value. `path` is the name of the layout's table, for example
/// "bus"; the help quotes it.
std::vector<LayoutFault> find_short_reach(const BusLayout& layout, const format::Chain& chain,
                                          double max_correction_m, const std::string& path);

}  // namespace plumb::drivers
