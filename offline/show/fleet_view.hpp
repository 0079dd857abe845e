// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "fleet/fleet.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// fleet.json, and `result` of `plumb fleet`: cells and, model by model, what is typical. Numbers
/// in the units of the screen, and in SI for `[fit] prior_from`.
Json fleet_json(const fleet::Fleet& fleet);

/// The verdict, a table of the cells (of many only those that need attention), what is typical.
std::string fleet_text(const fleet::Fleet& fleet);

}  // namespace plumb::offline::show
