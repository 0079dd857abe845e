// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "formula/dimension.hpp"

namespace plumb::offline {

/// A unit as users write it: "rad/(N m)", "urad/K", "1/s^2", "1".
struct WrittenUnit {
  Dimension dimension;
  double factor = 1.0;  // SI value = written value * factor
  std::string si;       // the same unit in SI: "rad/K"
};

/// The place where a text is no valid unit.
struct UnitError {
  std::size_t at = 0, length = 1;
  std::string message;
  std::string word = {};  // the name that is not a unit
};

/// Reads a unit. A blank multiplies, '/' divides by the next factor only, and '^' takes an integer.
std::variant<WrittenUnit, UnitError> parse_unit(std::string_view text);

std::vector<std::string> formula_units();

}  // namespace plumb::offline
