// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/drivers/bus_layout.hpp"

namespace plumb::drivers {

/// The holding registers of the layout, for people and for spreadsheets. `about`: of which cell.
std::string modbus_map_markdown(const BusLayout& layout, const std::string& about);

/// Columns register,registers,message,value,type,unit,factor,sender,period_us,meaning; a value is
/// the number times factor.
std::string modbus_map_csv(const BusLayout& layout);

}  // namespace plumb::drivers
