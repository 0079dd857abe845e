// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cell/measurements.hpp"

namespace plumb::offline {

struct Unit {
  Quantity quantity = Quantity::kNumber;
  double scale = 1.0;  // SI = scale * value + offset
  double offset = 0.0;
};

/// "mm", "deg", "degC" …; nothing if it is not a unit.
std::optional<Unit> unit_of(std::string_view name);

/// A header split into name and unit: "q1_deg" is q1 in deg; "pose" has no unit.
struct Heading {
  std::string name;
  std::string unit;
};
Heading split_heading(std::string_view header);

/// Every unit, for messages.
std::string unit_list();

}  // namespace plumb::offline
