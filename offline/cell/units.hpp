// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/quantity.hpp"

namespace plumb::offline {

/// SI = value * times / by + offset. Factors such as 1 / 1000 are stored as divisors, so that only
/// one rounding occurs.
/// Temperatures are kept in [degC].
struct Unit {
  Quantity quantity = Quantity::kNumber;
  double times = 1.0;
  double by = 1.0;
  double offset = 0.0;
  double to_si(double value) const { return value * times / by + offset; }
  double from_si(double si) const { return (si - offset) * by / times; }
};

/// "mm", "deg", "degC" …; nothing if it is not a unit.
std::optional<Unit> unit_of(std::string_view name);

/// A decimal text whose value in `unit` reads back to `si`: to the bit for what was read from a
/// file with up to 12 characters, else to one unit in the last place. Short texts are preferred:
/// 0.1157 m is "115.7" mm, not 115.70000000000002.
std::string text_in(const Unit& unit, double si);

/// A header split at its last underscore: "q1_deg" is q1 in deg; "pose" has no unit.
struct Heading {
  std::string name;
  std::string unit;
};
Heading split_heading(std::string_view header);

/// A unit that others use and plumb does not: it is converted, never taken for its neighbour.
struct ForeignUnit {
  std::string_view name, use, equals;  // "cm", "mm", "1 cm = 10 mm"
};
const ForeignUnit* foreign_unit(std::string_view name);

/// Every unit, for messages.
const std::vector<std::string>& unit_names();

}  // namespace plumb::offline
