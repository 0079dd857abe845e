// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/drivers/bus_port.hpp"
#include "program/outcome.hpp"
#include "twin/controller.hpp"
#include "twin/tracker.hpp"

namespace plumb::offline::twin {

/// Adds `loop` to the result and its lines to the text: what the controller saw of plumb-rt and of
/// the bus. An error (kBusLost) if it waited for corrections in vain.
void add_loop(const Controller& controller, const drivers::PortCounters& port, std::uint64_t missed,
              Outcome& outcome);

/// Adds `stops` to the result: when, how far from where it should be, with which correction.
void add_stops(const std::vector<Stop>& stops, const TrueErrors& errors, Outcome& outcome);

}  // namespace plumb::offline::twin
