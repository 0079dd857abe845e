// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace plumb::offline {

/// The units that a line above the table states, "Units: mm, deg", for columns that say none.
struct StatedUnits {
  std::string length, angle;
  int length_line = 0, angle_line = 0;

  bool none() const { return length.empty() && angle.empty(); }
};

/// Adds what a line states. A second, other unit of one kind makes that kind unknown.
void read_stated_units(std::string_view line, int number, StatedUnits& out);

/// True if the line speaks of units.
bool states_units(std::string_view line);

}  // namespace plumb::offline
