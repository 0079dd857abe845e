// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "fleet/fleet.hpp"

namespace plumb::offline::report {

/// Held-out error of every arm that could be fitted, from the best to the worst. Empty if none was.
std::string fleet_errors_figure(const fleet::Fleet& fleet, double width);

/// How the arms of a model differ from nominal: of every geometric number the mean and one standard
/// deviation from arm to arm, and the arms that are unlike them. Empty if nothing was learnt.
std::string sisters_figure(const fleet::Fleet& fleet, const fleet::Model& model, double width);

}  // namespace plumb::offline::report
