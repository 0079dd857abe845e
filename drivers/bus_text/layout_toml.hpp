// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bus_text/bus_arm.hpp"
#include "plumb/drivers/bus_layout.hpp"
#include "program/toml_table.hpp"

namespace plumb::drivers {

/// What a missing key owner_register means: the default register, or none. A folder that was
/// deployed by a version without this key must get none, because its controller may use the
/// register for something else.
enum class MissingOwner : std::uint8_t { kDefault, kNone };

/// Reads the table [bus] of rt.toml or [deploy.bus] of cell.toml. Keys that are not there have the
/// values of default_layout.
///
///   can_format = "classic"        # or "fd"
///   id_kind = "standard"          # or "extended"
///   byte_order = "little"         # of CAN values, counters and check sums; or "big"
///   word_order = "big"            # of the two registers of a Modbus value; or "little"
///   correction = "pose"           # or "offset": the difference to the target
///   owner_register = 1288         # where plumb-rt writes its number (Modbus); 0: nowhere
///   bit_rate = 1000000
///   data_bit_rate = 4000000       # of CAN FD
///   temperatures = ["temp"]       # sensors that the controller reports; or how many, in the order
///                                 # in which the model counts its own
///   [bus.target]                  # one table for each message; [bus.commanded] adds that message,
///                                 # which arms of up to six joints do not have otherwise
///   can_id = 0x118
///   register = 1048
///   period_us = 4000
///   count_um = 1                  # what a count of its lengths and angles is
///   count_urad = 1
///
/// Problems are reported to the table's source, among them unknown keys and every fault of the
/// layout (code BUS). After a problem the result must not be used.
BusLayout read_bus(TomlTable& bus, const BusArm& arm, BusUse use,
                   MissingOwner owner = MissingOwner::kDefault);

/// Reports a fault at its key, its message's table or the whole table (code BUS).
void report_fault(TomlTable& bus, const LayoutFault& fault);

/// Writes the same table with every key, so that nothing depends on a default value. `path` is the
/// name of the table, for example "bus".
std::string write_bus(const BusLayout& layout, const std::string& path);

}  // namespace plumb::drivers
