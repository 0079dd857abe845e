// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "plumb/drivers/bus_layout.hpp"

namespace plumb::drivers {

/// One sentence on a message, for DBC and Modbus map; without quotes, pipes and semicolons.
const char* meaning_of(MessageKind kind) noexcept;

/// The same of a value; empty: its name says it.
const char* meaning_of(MessageKind kind, const std::string& signal) noexcept;

/// Numbers that have a name.
struct NamedNumber {
  int number = 0;
  const char* name = "";
};
std::span<const NamedNumber> names_of(MessageKind kind, const std::string& signal) noexcept;

}  // namespace plumb::drivers
