// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/drivers/bus_layout.hpp"

namespace plumb::drivers {

/// The layout as a DBC file: one DBC message for each frame ("target_1", "target_2"), with its
/// values in their units, its counter and its check sum. `about` names the cell.
std::string write_dbc(const BusLayout& layout, const std::string& about);

}  // namespace plumb::drivers
