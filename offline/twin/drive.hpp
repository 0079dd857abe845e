// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "twin/controller.hpp"
#include "twin/links.hpp"

namespace plumb::offline::twin {

/// Drives the path without a bus, as fast as this machine computes: corrections off.
std::vector<Stop> drive_uncorrected(const Cell& cell, const Path& path,
                                    const ControllerSettings& settings);

/// Drives the path on the clock of this machine until the controller is done, `longest_s` have
/// gone by, or `stop` says so. Returns the points of the clock that were missed.
std::uint64_t drive_in_real_time(Controller& controller, Link& link, double cycle_s,
                                 double longest_s, const std::function<bool()>& stop);

}  // namespace plumb::offline::twin
