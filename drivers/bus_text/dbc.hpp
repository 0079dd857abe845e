// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/drivers/bus_layout.hpp"

namespace plumb::drivers {

/// The layout as a DBC file: a message a frame ("target_1", "target_2"), its values in their units,
/// counter and check sum. `about`: of which cell.
std::string write_dbc(const BusLayout& layout, const std::string& about);

}  // namespace plumb::drivers
