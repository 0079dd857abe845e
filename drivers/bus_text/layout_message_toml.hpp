// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/drivers/bus_layout.hpp"
#include "program/toml_table.hpp"

namespace plumb::drivers {

/// Reads can_id, register, period_us, count_um and count_urad of one message.
void read_message(TomlTable& table, MessageLayout& message);

/// A whole number from `least` to `most`; anything else is reported and counts as absent.
std::optional<std::uint32_t> whole_number(TomlTable& table, const std::string& key,
                                          std::uint32_t least, std::uint32_t most);

}  // namespace plumb::drivers
