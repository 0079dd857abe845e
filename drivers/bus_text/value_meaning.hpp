// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "plumb/drivers/bus_layout.hpp"

namespace plumb::drivers {

/// One sentence that describes a message, for the DBC file and the Modbus map. It contains no
/// quotes, pipes or semicolons.
const char* meaning_of(MessageKind kind) noexcept;

/// One sentence that describes a value; empty if the name of the value says enough.
const char* meaning_of(MessageKind kind, const std::string& signal) noexcept;

/// A number with a name, for example a state of the controller.
struct NamedNumber {
  int number = 0;
  const char* name = "";
};
std::span<const NamedNumber> names_of(MessageKind kind, const std::string& signal) noexcept;

}  // namespace plumb::drivers
