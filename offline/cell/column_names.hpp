// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/quantity.hpp"

namespace plumb::offline {

/// The quantity of a column that needs no unit (pose, repeat, qw, dir_j1, …), or nothing.
std::optional<Quantity> unitless_quantity(std::string_view header);

/// What a column of this name (without unit) may hold; empty for names of the user's own.
std::vector<Quantity> allowed_quantities(std::string_view name);

/// The unit to propose for a column without one: "q1" deg, "payload" kg, "x" mm.
std::string usual_unit(std::string_view name);

/// The known name that differs from `name` only by its case: "X" is x.
std::optional<std::string> known_spelling(std::string_view name);

/// The known name that a column of the user's own was perhaps meant to have: "paylod" is payload,
/// "sigma_x" is sx. Nothing for known names and for those far from all of them.
std::optional<std::string> misspelt(std::string_view name, Quantity quantity);

/// The same of a header without unit: "psoe" is pose, "Q1" is q1_deg.
std::optional<std::string> misspelt_header(std::string_view header);

/// The joint number behind a prefix: ("q12", "q") is 12; 0 if there is none.
int joint_number(std::string_view name, std::string_view prefix);

/// "a length", "an angle", …
const char* kind_name(Quantity quantity);

}  // namespace plumb::offline
