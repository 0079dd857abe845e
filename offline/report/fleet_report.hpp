// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "fleet/fleet.hpp"

namespace plumb::offline::report {

/// One self-contained HTML file about a fleet: which arms are good, which are unlike their sisters,
/// what is typical of each model. The same fleet gives the same bytes.
std::string fleet_report(const fleet::Fleet& fleet);

}  // namespace plumb::offline::report
