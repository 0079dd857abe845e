// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "twin/controller.hpp"
#include "twin/links.hpp"

namespace plumb::offline::twin {

/// Drives the path without a bus and without corrections, as fast as this machine computes.
std::vector<Stop> drive_uncorrected(const Cell& cell, const Path& path,
                                    const ControllerSettings& settings);

/// Drives the path in real time until the controller is done, `longest_s` have passed, or `stop`
/// returns true. Returns the number of missed cycles.
std::uint64_t drive_in_real_time(Controller& controller, Link& link, double cycle_s,
                                 double longest_s, const std::function<bool()>& stop);

}  // namespace plumb::offline::twin
