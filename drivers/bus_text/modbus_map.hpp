// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/drivers/bus_layout.hpp"

namespace plumb::drivers {

/// The holding registers of the layout as a table for people. `about` names the cell.
std::string modbus_map_markdown(const BusLayout& layout, const std::string& about);

/// The holding registers of the layout for spreadsheets, with the columns
/// register,registers,message,value,type,unit,factor,sender,period_us,meaning. A value is the
/// number in the register times the factor.
std::string modbus_map_csv(const BusLayout& layout);

}  // namespace plumb::drivers
