// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "plumb/drivers/modbus_settings.hpp"

namespace plumb::drivers {

/// The fault of settings with which no link can be started.
std::optional<LinkFault> find_fault(const ModbusClientSettings& settings);
std::optional<LinkFault> find_fault(const ModbusServerSettings& settings);

/// The largest number of registers between two messages that are read along. Over TCP they cost
/// less than another request, on a serial line more.
int widest_gap(const ModbusClientSettings& settings);

/// The fault that the system cannot create a thread.
LinkFault cannot_run(int error);

}  // namespace plumb::drivers
